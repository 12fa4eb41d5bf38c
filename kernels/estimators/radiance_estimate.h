// Estimator: radiance by a smoothing kernel of given radius, L = sum of f K_2(x - x_j) Phi_j
// [Knaus and Zwicker 2011, eq. 3]. Used by pppm.
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H
#include "density/kernels.h"

typedef struct Estimate {
    float8 red, green, blue;
} Estimate;

inline void estimator_begin(Estimate* estimate) { estimate->red = estimate->green = estimate->blue = (float8)(0.0f); }

// Eight photons at squared distances t_squared * radius^2; those not in `mask` (all bits set) count nothing.
inline void estimator_add(Estimate* estimate, int8 mask, float8 t_squared, float8 red, float8 green, float8 blue)
{
    const float8 weight = as_float8(mask & as_int8(kernel_shape(t_squared)));
    estimate->red += weight * red;
    estimate->green += weight * green;
    estimate->blue += weight * blue;
}

inline float sum8(float8 v)
{
    const float4 a = v.lo + v.hi;
    return (a.x + a.z) + (a.y + a.w);
}

// Irradiance-like sum (W/m^2, times emitted paths); .w is unused.
inline float4 estimator_end(const Estimate* estimate, float radius)
{
    return (float4)(sum8(estimate->red), sum8(estimate->green), sum8(estimate->blue), 0.0f) * (KERNEL_NORM / (radius * radius));
}

#endif
