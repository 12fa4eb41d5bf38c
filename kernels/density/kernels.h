// Smoothing kernels on the disk: K(x) = k(|x| / r) / r^2 with k(t) = KERNEL_NORM kernel_shape(t^2), which integrate to 1.
// -D DENSITY_KERNEL chooses. Numbers up to 3 are n of k(t) = (n + 1) / pi (1 - t^2)^n [Silverman 1986, section 4.2]; beyond
// them are the filters of photon maps: the cone 1 - t / c [Jensen 1996, section 4.2.1], and Jensen's Gaussian
// 1 - (1 - exp(-beta t^2 / 2)) / (1 - exp(-beta)), whose published factor 0.918 would lose half of the light.
#ifndef SUNDOG_DENSITY_KERNELS_H
#define SUNDOG_DENSITY_KERNELS_H
#include "math/warp.h"

#define KERNEL_UNIFORM 0
#define KERNEL_EPANECHNIKOV 1
#define KERNEL_BIWEIGHT 2
#define KERNEL_TRIWEIGHT 3
#define KERNEL_CONE 4
#define KERNEL_GAUSSIAN 5

#define CONE_WIDTH 1.1f        // c
#define GAUSSIAN_BETA 1.953f
#define GAUSSIAN_ENDS 0.858152f // 1 - exp(-beta)
#define GAUSSIAN_ALPHA 1.728309f // 1 / (integral of the shape over the disk, by its area)

#if DENSITY_KERNEL == KERNEL_CONE
#define KERNEL_NORM (INV_PI_F / (1.0f - 2.0f / (3.0f * CONE_WIDTH)))
#elif DENSITY_KERNEL == KERNEL_GAUSSIAN
#define KERNEL_NORM (INV_PI_F * GAUSSIAN_ALPHA)
#else
#define KERNEL_NORM ((DENSITY_KERNEL + 1) * INV_PI_F)
#endif

// k(t) / KERNEL_NORM for eight t^2 in [0, 1].
static inline float8 kernel_shape(float8 t_squared)
{
#if DENSITY_KERNEL == KERNEL_UNIFORM
    return (float8)(1.0f);
#elif DENSITY_KERNEL == KERNEL_CONE
    return 1.0f - sqrt(t_squared) * (1.0f / CONE_WIDTH);
#elif DENSITY_KERNEL == KERNEL_GAUSSIAN
    return 1.0f - (1.0f - native_exp(t_squared * (-0.5f * GAUSSIAN_BETA))) * (1.0f / GAUSSIAN_ENDS);
#else
    const float8 s = 1.0f - t_squared;
#if DENSITY_KERNEL == KERNEL_EPANECHNIKOV
    return s;
#elif DENSITY_KERNEL == KERNEL_BIWEIGHT
    return s * s;
#else
    return s * s * s;
#endif
#endif
}

#endif
