// Parameters of photonmapper's maps, and the lookups that follow from them.
#pragma once

#include "methods/render_context.h"
#include "methods/standard_parameters.h"
#include "stages/fixed_photon_map.h"

namespace sundog
{

ParameterSpec maps_spec();
ParameterSpec global_photons_spec();
ParameterSpec global_radius_spec();
ParameterSpec caustic_photons_spec();
ParameterSpec caustic_radius_spec();
ParameterSpec lookup_spec();
ParameterSpec nearest_spec();
ParameterSpec relaxation_spec();
ParameterSpec progressive_relaxation_spec();
ParameterSpec final_gather_spec();
ParameterSpec precompute_spec();
ParameterSpec save_map_spec();
ParameterSpec load_map_spec();

// Light subpaths of the global map: `photons`, or one a pixel, but never so few that its automatic radius would blur the whole scene.
std::size_t global_path_count(const Parameters& parameters, std::size_t pixels);

bool has_fresh_maps(const Parameters& parameters);

// light_paths: emitted for the map.
PhotonLookup global_lookup(const RenderContext& context, const Parameters& parameters, std::uint64_t light_paths);
PhotonLookup caustic_lookup(const RenderContext& context, const Parameters& parameters, std::uint64_t light_paths);

} // namespace sundog
