// Estimator: radiance by a smoothing kernel, and where in the disk the photons lie: two rings of equal area and six
// sectors, for the chi-squared test of [Lin et al. 2020, section 4].
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H
#include "estimators/weighted_flux.h"
#include "math/frame.h"
#include "math/simd8.h"
#include "shared/binned_photons.h"
#include "shared/photon.h"

#define ESTIMATOR_RESULT BinnedSum

typedef struct Estimate {
    WeightedFlux flux;
    float3 s, t; // span the tangent plane
    uint bins[DISK_BINS];
} Estimate;

static inline void estimator_begin(Estimate* estimate, const GatherQuery* query)
{
    estimate->flux = no_flux();
    const Frame frame = make_frame(unpack(query->normal));
    estimate->s = frame.s;
    estimate->t = frame.t;
    for (uint i = 0u; i < DISK_BINS; ++i) estimate->bins[i] = 0u;
}

// Which bin: three lines through the middle part the sectors, and t^2 = 1/2 the rings.
static inline int8 bin_of(const Estimate* estimate, Offset8 offset, float8 t_squared)
{
    const float8 u = offset.x * estimate->s.x + offset.y * estimate->s.y + offset.z * estimate->s.z;
    const float8 v = offset.x * estimate->t.x + offset.y * estimate->t.y + offset.z * estimate->t.z;
    const float8 slanted = u * 1.7320508f;
    const int8 above = v > 0.0f, left = v > slanted, right = v > -slanted; // of the lines at 0, 60 and 120 degrees; -1 where true
    const int8 sector = above ? 1 - left + right : 4 + left - right;
    return sector + ((t_squared < 0.5f) ? (int8)(0) : (int8)(RING_BINS));
}

static inline void estimator_add(Estimate* estimate, int8 mask, Offset8 offset, float8 t_squared, float8 red, float8 green, float8 blue)
{
    add_flux(&estimate->flux, mask, t_squared, red, green, blue);
    int bin[8];
    vstore8(bin_of(estimate, offset, t_squared), 0, bin);
    for (int lanes = mask8(mask); lanes != 0; lanes &= lanes - 1) estimate->bins[bin[first_lane(lanes)]]++;
}

static inline ESTIMATOR_RESULT estimator_end(const Estimate* estimate, float radius)
{
    ESTIMATOR_RESULT sum = {irradiance_of(&estimate->flux, radius), {0u}};
    for (uint i = 0u; i < DISK_BINS; ++i) sum.bins[i] = estimate->bins[i];
    return sum;
}

#endif
