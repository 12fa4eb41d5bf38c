// Photons counted by equal areas of the disk that a query searches, and what chi-squared tests of the counts have
// made of a pixel's radius [Lin et al. 2020, ACM TOG 39(6)].
#ifndef SUNDOG_SHARED_BINNED_PHOTONS_H
#define SUNDOG_SHARED_BINNED_PHOTONS_H
#include "shared/vec3.h"
SHARED_BEGIN

// Two rings of equal area, the inner one first, in six sectors each.
#define RING_BINS 6u
#define DISK_BINS 12u

// What estimators/binned_radiance.h returns.
typedef struct BinnedSum {
    Vec3 irradiance;      // W/m^2, times emitted paths
    uint bins[DISK_BINS]; // photons
} BinnedSum;
SHARED_SIZE(BinnedSum, 60);

// A pixel's radius and the photons since it last changed.
typedef struct TestedPixel {
    float radius_squared; // m^2
    float first_test;     // photons before the counts are tested for the first time
    float next_test;      // photons before they are tested again
    uint tests;           // since the radius changed, all passed
    uint bins[DISK_BINS];
} TestedPixel;
SHARED_SIZE(TestedPixel, 64);

// Statistics above which a test fails: of all bins, and of the inner ring's.
typedef struct TestThreshold {
    float disk;
    float inner_ring;
} TestThreshold;
SHARED_SIZE(TestThreshold, 8);

// Later tests of the same counts use the last threshold: by then there would be 2^31 times the first test's photons.
#define TEST_THRESHOLDS 32u

SHARED_END
#endif
