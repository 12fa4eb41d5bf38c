// The Laplacian of the triweight kernel 4 / (pi r^2) (1 - t^2)^3,
//   K_Delta(x) = 48 / (pi r^4) (1 - t^2) (3 t^2 - 1),
// which integrates to 0 and turns a paraboloid's irradiance into its Laplacian exactly [Hachisuka, Jarosz and Jensen 2010:
// derivatives of a smooth kernel].
#ifndef SUNDOG_DENSITY_LAPLACIAN_KERNEL_H
#define SUNDOG_DENSITY_LAPLACIAN_KERNEL_H
#include "math/warp.h"

// K_Delta / laplacian_norm(r) for eight t^2 in [0, 1].
static inline float8 laplacian_shape(float8 t_squared)
{
    return (1.0f - t_squared) * (3.0f * t_squared - 1.0f);
}

static inline float laplacian_norm(float radius)
{
    const float inverse_square = 1.0f / (radius * radius);
    return (48.0f * INV_PI_F) * inverse_square * inverse_square;
}

#endif
