#include "methods/photon_pass.h"

#include <algorithm>

namespace sundog {

namespace {

// Query paths are specular chains: they keep their throughput, and rarely live this long.
constexpr uint query_rr_depth = 8;

PathRules query_rules(const Parameters& parameters)
{
    return {path_rules(parameters).max_depth, query_rr_depth};
}

} // namespace

PhotonPass::PhotonPass(RenderContext& context, const Parameters& parameters)
    : context_(context), light_paths_(light_path_count(parameters, context.film.pixel_count())),
      first_radius_(initial_radius(parameters, context.scene.radius(), light_paths_, pixel_footprint(context.camera, context.scene.bounds()))),
      pool_(context.device, context.scene, std::max(light_paths_, context.film.pixel_count())),
      photons_(context.device, context.scene, {light_paths_, path_rules(parameters), parameters.text("direct") == "nee", sampler_kind(parameters)}),
      camera(context.device, context.camera, context.filter, sampler_kind(parameters), context.scene.surface_options()),
      queries(context.device, context.scene, camera.count(), query_rules(parameters), parameters.text("direct") == "nee", sampler_kind(parameters)),
      map(context.device, context.scene.bounds())
{
}

void PhotonPass::trace(std::uint64_t iteration, float radius)
{
    const SamplerKey key = sampler_key(context_.seed, iteration);
    camera.start(context_.scene, pool_, key);
    camera.record_first_hits(context_.scene, pool_, iteration, context_.film.first_hits);
    queries.trace(context_.scene, camera, pool_, key, radius);

    const std::size_t stored = photons_.trace(context_.scene, pool_, key);
    map.build(photons_.photons(), stored, radius);
    photons_stored_ += stored;
    iterations_++;
}

void PhotonPass::serialize(StateArchive& archive)
{
    archive.value("photon iterations", iterations_);
    archive.value("photons stored", photons_stored_);
    pool_.serialize(archive);
    photons_.serialize(archive);
}

MethodCounters PhotonPass::counters() const
{
    return {iterations_ * light_paths_, iterations_ * camera.count(), photons_stored_, pool_.rays_traced()};
}

} // namespace sundog
