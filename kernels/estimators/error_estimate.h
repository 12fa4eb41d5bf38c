// Estimator of what density estimation does wrong: the Laplacian of the irradiance in the tangent plane, to which its bias
// is proportional, and the second moment of single photons' contributions, to which its variance is. The Laplacian is by
// that of the triweight kernel,
//   48 / (pi h^4) (1 - t^2) (3 t^2 - 1),
// which integrates to 0 and turns a paraboloid's irradiance into its Laplacian exactly [Hachisuka et al. 2010, section
// 4.2: derivatives of a smooth kernel]. Used by appm.
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H
#include "math/luminance.h"
#include "math/simd8.h"
#include "math/sum8.h"
#include "math/warp.h"
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
    const float8 weight = (1.0f - t_squared) * (3.0f * t_squared - 1.0f);
    const float8 contribution = red * estimate->luminance.x + green * estimate->luminance.y + blue * estimate->luminance.z;
    estimate->red += as_float8(mask & as_int8(weight * red));
    estimate->green += as_float8(mask & as_int8(weight * green));
    estimate->blue += as_float8(mask & as_int8(weight * blue));
    estimate->squares += as_float8(mask & as_int8(contribution * contribution));
    estimate->photons -= mask;
}

static inline ESTIMATOR_RESULT estimator_end(const Estimate* estimate, float radius)
{
    const float by_area = INV_PI_F / (radius * radius);
    const float scale = 48.0f * by_area / (radius * radius);
    const ESTIMATOR_RESULT sum = {{sum8(estimate->red) * scale, sum8(estimate->green) * scale, sum8(estimate->blue) * scale},
                                  sum8(estimate->squares) * by_area,
                                  sum8(convert_float8(estimate->photons))};
    return sum;
}

#endif
