// What a pixel learns about the error of its density estimates [Kaplanyan and Dachsbacher 2013, ACM TOG 32(2)].
#ifndef SUNDOG_SHARED_ADAPTIVE_RADIUS_H
#define SUNDOG_SHARED_ADAPTIVE_RADIUS_H
#include "shared/vec3.h"
SHARED_BEGIN

// What estimators/error_estimate.h returns.
typedef struct ErrorSum {
    Vec3 laplacian;      // of the irradiance (W/m^4), times emitted paths
    float second_moment; // sum of (beta f Phi)^2 over photons, in luminance, by area (1/m^2)
    float photons;
} ErrorSum;
SHARED_SIZE(ErrorSum, 20);

// Means over iterations, in luminance.
typedef struct AdaptivePixel {
    float radius_squared;      // of the next iteration (m^2)
    float second_moment;       // E[(beta f Phi)^2] p of one light subpath
    float laplacian;           // of the radiance (1/m^2)
    float laplacian_deviation; // sum of squared deviations from that mean [Welford 1962]
    float photons;             // that all this was learned from
} AdaptivePixel;
SHARED_SIZE(AdaptivePixel, 20);

// How radii follow from that: constants of an iteration, and of the kernel K_2(x) = k(|x| / r) / r^2.
typedef struct AdaptiveSchedule {
    float iterations;     // done so far, this one included
    float light_subpaths; // an iteration's
    float kernel_moment;  // mu_2: the second moment of k along an axis
    float kernel_square;  // R: the integral of k^2
    float largest_radius; // of the next iteration (m)
    float smallest_radius;
} AdaptiveSchedule;
SHARED_SIZE(AdaptiveSchedule, 24);

SHARED_END
#endif
