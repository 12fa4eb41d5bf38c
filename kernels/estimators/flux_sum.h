// Estimator: flux and number of the photons within the radius, which progressive statistics rescale
// afterwards [Hachisuka et al. 2008, section 4]. Used by sppm.
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H
#include "math/simd8.h"
#include "math/sum8.h"
#include "shared/photon.h"

#define ESTIMATOR_RESULT GatherSum

typedef struct Estimate {
    float8 red, green, blue;
    int8 count;
} Estimate;

static inline void estimator_begin(Estimate* estimate, const GatherQuery* query)
{
    estimate->red = estimate->green = estimate->blue = (float8)(0.0f);
    estimate->count = (int8)(0);
}

// Eight photons; those not in `mask` (all bits set) count nothing.
static inline void estimator_add(Estimate* estimate, int8 mask, Offset8 offset, float8 t_squared, float8 red, float8 green, float8 blue)
{
    estimate->red += as_float8(mask & as_int8(red));
    estimate->green += as_float8(mask & as_int8(green));
    estimate->blue += as_float8(mask & as_int8(blue));
    estimate->count -= mask;
}

// Flux (W, times emitted paths) and the number of photons.
static inline ESTIMATOR_RESULT estimator_end(const Estimate* estimate, float radius)
{
    const ESTIMATOR_RESULT sum = {{sum8(estimate->red), sum8(estimate->green), sum8(estimate->blue)}, sum8(convert_float8(estimate->count))};
    return sum;
}

#endif
