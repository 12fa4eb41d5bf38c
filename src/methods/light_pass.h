// The light's half of an iteration: light paths -> photons -> map.
#pragma once

#include "methods/render_context.h"
#include "methods/standard_parameters.h"
#include "stages/light_paths.h"
#include "stages/photon_map.h"

namespace sundog
{

class LightPass
{
public:
    // direct_light_elsewhere: photons straight from a light are left out.
    LightPass(RenderContext& context, const Parameters& parameters, bool direct_light_elsewhere);

    // Traces the light paths of one iteration in the pool and sorts their photons for queries of at most `radius`.
    void trace(PathPool& pool, SamplerKey key, float radius);

    // Sorts the same photons for queries of at most another radius.
    void sort_again(float radius) { map.build(photons_.photons(), stored_, radius); }

    std::size_t light_paths() const { return light_paths_; } // an iteration
    std::uint64_t photons_stored() const { return photons_stored_; }
    void serialize(StateArchive& archive);

private:
    const DeviceScene& scene_;
    std::size_t light_paths_;
    std::uint64_t photons_stored_ = 0;
    std::size_t stored_ = 0; // in this iteration
    PhotonTracer photons_;

public:
    PhotonMap map;
};

// Query paths are specular chains: they keep their throughput, and rarely live long enough for Russian roulette.
PathRules query_rules(const Parameters& parameters);

// The radius of the first iteration: the parameter, or what suits the scene.
float first_radius(const RenderContext& context, const Parameters& parameters, double target_pixels = usual_target_pixels);

} // namespace sundog
