// Estimator: radiance by a smoothing kernel of given radius, L = sum of f K_2(x - x_j) Phi_j
// [Knaus and Zwicker 2011, eq. 3]. Used by photonmapper, and with radii that no photons change.
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H
#include "estimators/weighted_flux.h"
#include "math/simd8.h"
#include "shared/photon.h"

#define ESTIMATOR_RESULT GatherSum

typedef WeightedFlux Estimate;

static inline void estimator_begin(Estimate* estimate, const GatherQuery* query) { *estimate = no_flux(); }

static inline void estimator_add(Estimate* estimate, int8 mask, Offset8 offset, float8 t_squared, float8 red, float8 green, float8 blue)
{
    add_flux(estimate, mask, t_squared, red, green, blue);
}

static inline ESTIMATOR_RESULT estimator_end(const Estimate* estimate, float radius)
{
    const ESTIMATOR_RESULT sum = {irradiance_of(estimate, radius), 0.0f};
    return sum;
}

#endif
