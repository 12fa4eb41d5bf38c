// What a pixel learns about the error of its density estimates [Kaplanyan and Dachsbacher 2013, ACM TOG 32(2)].
#ifndef SUNDOG_SHARED_ADAPTIVE_RADIUS_H
#define SUNDOG_SHARED_ADAPTIVE_RADIUS_H
#include "shared/vec3.h"
SHARED_BEGIN

// What estimators/moment_estimate.h returns.
typedef struct MomentSum {
    Vec3 irradiance;     // W/m^2, times emitted paths
    float second_moment; // sum of (K beta f Phi)^2 over photons, in luminance
} MomentSum;
SHARED_SIZE(MomentSum, 16);

// Means over iterations, in luminance.
typedef struct AdaptivePixel {
    float radius_squared;      // of the next iteration (m^2)
    float variance;            // V_1: an iteration's variance times r^2 and light subpaths
    float laplacian;           // of the radiance (1/m^2)
    float laplacian_deviation; // sum of squared deviations from that mean [Welford 1962]
} AdaptivePixel;
SHARED_SIZE(AdaptivePixel, 16);

// How radii follow from that: constants of an iteration.
typedef struct AdaptiveSchedule {
    float iterations;     // done so far, this one included
    float light_subpaths; // an iteration's
    float second_moment;  // mu_2 of the kernel
    float largest_radius; // of the next iteration (m)
    float smallest_radius;
} AdaptiveSchedule;
SHARED_SIZE(AdaptiveSchedule, 20);

SHARED_END
#endif
