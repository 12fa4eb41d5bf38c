// The film's accumulators and the statistics of progressive methods.
#ifndef SUNDOG_SHARED_FILM_H
#define SUNDOG_SHARED_FILM_H
#include "shared/vec3.h"
SHARED_BEGIN

// Sums over iterations, each kept as value and rounding error so that 10^5 iterations do not drift
// (Neumaier's compensated summation).
typedef struct FilmPixel {
    Vec3 sum;
    Vec3 sum_error;
    Vec3 squares;
    Vec3 squares_error;
} FilmPixel;
SHARED_SIZE(FilmPixel, 48);

// What the camera sees first: means over iterations.
typedef struct FirstHitPixel {
    Vec3 albedo;
    Vec3 normal;
    float depth; // distance from the camera; 0 for the background
} FirstHitPixel;
SHARED_SIZE(FirstHitPixel, 28);

// A contribution of a light path to a pixel.
typedef struct Splat {
    Vec3 radiance;
    uint pixel;
} Splat;
SHARED_SIZE(Splat, 16);

// [Hachisuka and Jensen 2009] statistics of a pixel, or of a hit point.
typedef struct ProgressivePixel {
    Vec3 tau;             // flux within the radius, scaled to it, times camera throughput
    float radius_squared; // m^2
    float count;          // N: photons accumulated, with the rounding error beside it
    float count_error;
} ProgressivePixel;
SHARED_SIZE(ProgressivePixel, 24);

// Sum over iterations of the radiance that is not from photons (W/m^2/sr), compensated as above.
typedef struct DirectSum {
    Vec3 sum;
    Vec3 error;
} DirectSum;
SHARED_SIZE(DirectSum, 24);

SHARED_END
#endif
