// Flux of photons times a smoothing kernel: what radiance_estimate.h and its like add up.
#ifndef SUNDOG_WEIGHTED_FLUX_H
#define SUNDOG_WEIGHTED_FLUX_H
#include "density/kernels.h"
#include "math/sum8.h"
#include "math/vec3.h"

typedef struct WeightedFlux {
    float8 red, green, blue;
} WeightedFlux;

static inline WeightedFlux no_flux(void)
{
    const WeightedFlux none = {(float8)(0.0f), (float8)(0.0f), (float8)(0.0f)};
    return none;
}

// Eight photons at squared distances t_squared * radius^2; those not in `mask` (all bits set) count nothing.
static inline void add_flux(WeightedFlux* sum, int8 mask, float8 t_squared, float8 red, float8 green, float8 blue)
{
    // The products are masked, not the weight: a lane beyond the map may hold anything, and 0 * NaN is no 0.
    const float8 weight = kernel_shape(t_squared);
    sum->red += as_float8(mask & as_int8(weight * red));
    sum->green += as_float8(mask & as_int8(weight * green));
    sum->blue += as_float8(mask & as_int8(weight * blue));
}

// Irradiance (W/m^2, times emitted paths).
static inline Vec3 irradiance_of(const WeightedFlux* sum, float radius)
{
    const float scale = KERNEL_NORM / (radius * radius);
    const Vec3 irradiance = {sum8(sum->red) * scale, sum8(sum->green) * scale, sum8(sum->blue) * scale};
    return irradiance;
}

#endif
