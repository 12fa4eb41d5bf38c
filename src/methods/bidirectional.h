// Bidirectional methods: subpaths from the camera and from the lights, joined by connections [Veach and Guibas 1995; Lafortune
// and Willems 1993], by merging, or by both [Georgiev et al. 2012; Hachisuka et al. 2012], or by photons gathered without bias
// [Qin et al. 2015], under the balance heuristic.
#pragma once

#include "methods/method.h"
#include "methods/regularization_schedule.h"

#include <optional>

namespace sundog
{

enum class PhotonUse { none, merged, gathered }; // gathered: without bias

// Which techniques a method has.
struct JoinedBy {
    bool connections = true; // with next-event estimation and splats of light subpaths
    PhotonUse photons = PhotonUse::merged;
};

// What `connections` says.
bool has_connections(const Parameters& parameters);

// schedule: of what specular vertices before a light add; none: nothing.
std::unique_ptr<Method> make_bidirectional(RenderContext& context, const Parameters& parameters, JoinedBy joined_by,
                                           std::optional<RegularizationSchedule> schedule = {});

// What they have in common, and what connections and merging add. choices: of `connections`.
std::vector<ParameterSpec> bidirectional_specs();
std::vector<ParameterSpec> connection_specs(const std::vector<std::string>& choices);
std::vector<ParameterSpec> merging_specs();

std::vector<ParameterSpec> joined(std::vector<ParameterSpec> first, const std::vector<ParameterSpec>& second);

} // namespace sundog
