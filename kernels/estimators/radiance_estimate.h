// Estimator: radiance by a smoothing kernel of given radius, L = sum of f K_2(x - x_j) Phi_j
// [Knaus and Zwicker 2011, eq. 3]. Used by pppm.
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H
#include "density/kernels.h"
#include "math/simd8.h"
#include "math/sum8.h"
#include "shared/photon.h"

#define ESTIMATOR_RESULT GatherSum

typedef struct Estimate {
    float8 red, green, blue;
} Estimate;

static inline void estimator_begin(Estimate* estimate, const GatherQuery* query) { estimate->red = estimate->green = estimate->blue = (float8)(0.0f); }

// Eight photons at squared distances t_squared * radius^2; those not in `mask` (all bits set) count nothing.
static inline void estimator_add(Estimate* estimate, int8 mask, Offset8 offset, float8 t_squared, float8 red, float8 green, float8 blue)
{
    // The products are masked, not the weight: a lane beyond the map may hold anything, and 0 * NaN is no 0.
    const float8 weight = kernel_shape(t_squared);
    estimate->red += as_float8(mask & as_int8(weight * red));
    estimate->green += as_float8(mask & as_int8(weight * green));
    estimate->blue += as_float8(mask & as_int8(weight * blue));
}

// Irradiance (W/m^2, times emitted paths).
static inline ESTIMATOR_RESULT estimator_end(const Estimate* estimate, float radius)
{
    const float scale = KERNEL_NORM / (radius * radius);
    const ESTIMATOR_RESULT sum = {{sum8(estimate->red) * scale, sum8(estimate->green) * scale, sum8(estimate->blue) * scale}, 0.0f};
    return sum;
}

#endif
