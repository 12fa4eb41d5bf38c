// Estimator of what density estimation does wrong: the Laplacian of the irradiance in the tangent plane, to which its bias
// is proportional, and the second moment of single photons' contributions, to which its variance is. Used by appm.
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H
#include "density/laplacian_kernel.h"
#include "math/luminance.h"
#include "math/simd8.h"
#include "math/sum8.h"
#include "shared/adaptive_radius.h"
#include "shared/photon.h"

#define ESTIMATOR_RESULT ErrorSum

typedef struct Estimate {
    float8 red, green, blue;
    float8 squares;
    float3 luminance; // of the camera path's throughput: what a unit of each colour adds
    int8 photons;
} Estimate;

static inline void estimator_begin(Estimate* estimate, const GatherQuery* query)
{
    estimate->red = estimate->green = estimate->blue = estimate->squares = (float8)(0.0f);
    estimate->luminance = unpack(query->throughput) * LUMINANCE_WEIGHTS;
    estimate->photons = (int8)(0);
}

static inline void estimator_add(Estimate* estimate, int8 mask, Offset8 offset, float8 t_squared, float8 red, float8 green, float8 blue)
{
    const float8 weight = laplacian_shape(t_squared);
    const float8 contribution = red * estimate->luminance.x + green * estimate->luminance.y + blue * estimate->luminance.z;
    estimate->red += as_float8(mask & as_int8(weight * red));
    estimate->green += as_float8(mask & as_int8(weight * green));
    estimate->blue += as_float8(mask & as_int8(weight * blue));
    estimate->squares += as_float8(mask & as_int8(contribution * contribution));
    estimate->photons -= mask;
}

static inline ESTIMATOR_RESULT estimator_end(const Estimate* estimate, float radius)
{
    const float scale = laplacian_norm(radius);
    const ESTIMATOR_RESULT sum = {{sum8(estimate->red) * scale, sum8(estimate->green) * scale, sum8(estimate->blue) * scale},
                                  sum8(estimate->squares) * (INV_PI_F / (radius * radius)),
                                  sum8(convert_float8(estimate->photons))};
    return sum;
}

#endif
