// Smoothing kernels on the disk: K(x) = k(|x| / r) / r^2 with k(t) = (n + 1) / pi (1 - t^2)^n, which integrate
// to 1 [Silverman 1986, section 4.2]. -D DENSITY_KERNEL is n.
#ifndef SUNDOG_DENSITY_KERNELS_H
#define SUNDOG_DENSITY_KERNELS_H
#include "math/warp.h"

#define KERNEL_UNIFORM 0
#define KERNEL_EPANECHNIKOV 1
#define KERNEL_BIWEIGHT 2
#define KERNEL_TRIWEIGHT 3

#define KERNEL_NORM ((DENSITY_KERNEL + 1) * INV_PI_F)

// k(t) / KERNEL_NORM for eight t^2 in [0, 1].
static inline float8 kernel_shape(float8 t_squared)
{
    const float8 s = 1.0f - t_squared;
#if DENSITY_KERNEL == KERNEL_UNIFORM
    return (float8)(1.0f);
#elif DENSITY_KERNEL == KERNEL_EPANECHNIKOV
    return s;
#elif DENSITY_KERNEL == KERNEL_BIWEIGHT
    return s * s;
#else
    return s * s * s;
#endif
}

#endif
