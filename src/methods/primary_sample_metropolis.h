// Primary sample space Metropolis light transport [Kelemen et al. 2002, A Simple and Robust Mutation Strategy for the Metropolis
// Light Transport Algorithm, Computer Graphics Forum 21(3)].
#pragma once

#include "methods/method.h"
#include "methods/regularization_schedule.h"

#include <optional>

namespace sundog
{

// Of paths that `paths` says: those of bdpt, or else of path. schedule: of what specular vertices before a light add; none: nothing.
std::unique_ptr<Method> make_primary_sample_metropolis(RenderContext& context, const Parameters& parameters,
                                                       std::optional<RegularizationSchedule> schedule = {});

// Parameters of the chains.
std::vector<ParameterSpec> chain_specs();

} // namespace sundog
