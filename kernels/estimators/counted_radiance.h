// Estimator: radiance by a smoothing kernel, and how many photons it comes from, which local radii shrink by
// [Hachisuka et al. 2008, section 4].
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H
#include "estimators/weighted_flux.h"
#include "math/simd8.h"
#include "shared/photon.h"

#define ESTIMATOR_RESULT GatherSum

typedef struct Estimate {
    WeightedFlux flux;
    int8 count;
} Estimate;

static inline void estimator_begin(Estimate* estimate, const GatherQuery* query)
{
    estimate->flux = no_flux();
    estimate->count = (int8)(0);
}

static inline void estimator_add(Estimate* estimate, int8 mask, Offset8 offset, float8 t_squared, float8 red, float8 green, float8 blue)
{
    add_flux(&estimate->flux, mask, t_squared, red, green, blue);
    estimate->count -= mask;
}

static inline ESTIMATOR_RESULT estimator_end(const Estimate* estimate, float radius)
{
    const ESTIMATOR_RESULT sum = {irradiance_of(&estimate->flux, radius), sum8(convert_float8(estimate->count))};
    return sum;
}

#endif
