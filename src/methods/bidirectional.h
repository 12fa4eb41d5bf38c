// Bidirectional methods: subpaths from the camera and from the lights, joined by connections [Veach and Guibas 1995; Lafortune
// and Willems 1993], by merging, or by both [Georgiev et al. 2012; Hachisuka et al. 2012], under the balance heuristic.
#pragma once

#include "methods/method.h"

namespace sundog
{

// Which techniques a method has.
struct JoinedBy {
    bool connections = true; // with next-event estimation and splats of light subpaths
    bool merging = true;
};

std::unique_ptr<Method> make_bidirectional(RenderContext& context, const Parameters& parameters, JoinedBy joined_by);

// What they have in common, and what merging adds.
std::vector<ParameterSpec> bidirectional_specs();
std::vector<ParameterSpec> merging_specs();

} // namespace sundog
