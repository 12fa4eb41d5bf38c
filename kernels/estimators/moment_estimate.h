// Estimator: radiance by a smoothing kernel, and the second moment of what single photons add to it, which is its
// variance [Kaplanyan and Dachsbacher 2013, section 4]. Used by appm.
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H
#include "density/kernels.h"
#include "math/luminance.h"
#include "math/simd8.h"
#include "math/sum8.h"
#include "shared/adaptive_radius.h"
#include "shared/photon.h"

#define ESTIMATOR_RESULT MomentSum

typedef struct Estimate {
    float8 red, green, blue;
    float8 squares;
    float3 luminance; // of the camera path's throughput: what a unit of each colour adds
} Estimate;

static inline void estimator_begin(Estimate* estimate, const GatherQuery* query)
{
    estimate->red = estimate->green = estimate->blue = estimate->squares = (float8)(0.0f);
    estimate->luminance = unpack(query->throughput) * LUMINANCE_WEIGHTS;
}

static inline void estimator_add(Estimate* estimate, int8 mask, Offset8 offset, float8 t_squared, float8 red, float8 green, float8 blue)
{
    const float8 weight = kernel_shape(t_squared);
    const float8 added = weight * (red * estimate->luminance.x + green * estimate->luminance.y + blue * estimate->luminance.z);
    estimate->red += as_float8(mask & as_int8(weight * red));
    estimate->green += as_float8(mask & as_int8(weight * green));
    estimate->blue += as_float8(mask & as_int8(weight * blue));
    estimate->squares += as_float8(mask & as_int8(added * added));
}

static inline ESTIMATOR_RESULT estimator_end(const Estimate* estimate, float radius)
{
    const float scale = KERNEL_NORM / (radius * radius);
    const ESTIMATOR_RESULT sum = {{sum8(estimate->red) * scale, sum8(estimate->green) * scale, sum8(estimate->blue) * scale},
                                  sum8(estimate->squares) * scale * scale};
    return sum;
}

#endif
