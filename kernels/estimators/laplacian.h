// Estimator: the Laplacian of the irradiance in the tangent plane, to which the bias of density estimation is proportional
// [Hachisuka, Jarosz and Jensen 2010]. Used wherever errors are estimated, but for appm, which has error_estimate.h; by nearest_laplacian.h for the k nearest photons.
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H
#include "density/laplacian_kernel.h"
#include "math/simd8.h"
#include "math/sum8.h"
#include "shared/error_estimate.h"
#include "shared/photon.h"

#define ESTIMATOR_RESULT LaplacianSum

typedef struct Estimate {
    float8 red, green, blue;
} Estimate;

static inline void estimator_begin(Estimate* estimate, const GatherQuery* query)
{
    estimate->red = estimate->green = estimate->blue = (float8)(0.0f);
}

static inline void estimator_add(Estimate* estimate, int8 mask, Offset8 offset, float8 t_squared, float8 red, float8 green, float8 blue)
{
#if WITHOUT_KTH_PHOTON
    // It lies on the rim of the lookup's own disk, up to rounding.
    mask &= fabs(t_squared * (NARROWEST_LAPLACIAN * NARROWEST_LAPLACIAN) - 1.0f) > (float8)(1e-5f);
#endif
    const float8 weight = laplacian_shape(t_squared);
    estimate->red += as_float8(mask & as_int8(weight * red));
    estimate->green += as_float8(mask & as_int8(weight * green));
    estimate->blue += as_float8(mask & as_int8(weight * blue));
}

static inline ESTIMATOR_RESULT estimator_end(const Estimate* estimate, float radius)
{
    const float norm = laplacian_norm(radius);
    const ESTIMATOR_RESULT sum = {{sum8(estimate->red) * norm, sum8(estimate->green) * norm, sum8(estimate->blue) * norm}};
    return sum;
}

#endif
