// Estimator: the Laplacian of the irradiance in the tangent plane, by the Laplacian of the triweight kernel,
//   48 / (pi h^4) (1 - t^2) (3 t^2 - 1),
// which integrates to 0 and turns a paraboloid's irradiance into its Laplacian exactly [Hachisuka et al. 2010, section
// 4.2: derivatives of a smooth kernel]. Used by appm.
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H
#include "math/simd8.h"
#include "math/sum8.h"
#include "math/warp.h"
#include "shared/photon.h"

#define ESTIMATOR_RESULT GatherSum

typedef struct Estimate {
    float8 red, green, blue;
} Estimate;

static inline void estimator_begin(Estimate* estimate, const GatherQuery* query) { estimate->red = estimate->green = estimate->blue = (float8)(0.0f); }

static inline void estimator_add(Estimate* estimate, int8 mask, Offset8 offset, float8 t_squared, float8 red, float8 green, float8 blue)
{
    const float8 weight = (1.0f - t_squared) * (3.0f * t_squared - 1.0f);
    estimate->red += as_float8(mask & as_int8(weight * red));
    estimate->green += as_float8(mask & as_int8(weight * green));
    estimate->blue += as_float8(mask & as_int8(weight * blue));
}

// W/m^4, times emitted paths.
static inline ESTIMATOR_RESULT estimator_end(const Estimate* estimate, float radius)
{
    const float scale = 48.0f * INV_PI_F / (radius * radius * radius * radius);
    const ESTIMATOR_RESULT sum = {{sum8(estimate->red) * scale, sum8(estimate->green) * scale, sum8(estimate->blue) * scale}, 0.0f};
    return sum;
}

#endif
