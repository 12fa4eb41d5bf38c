#include "methods/photon_pass.h"

#include <algorithm>

namespace sundog
{

PhotonPass::PhotonPass(RenderContext& context, const Parameters& parameters, bool finds_laplacians)
    : context_(context), first_radius_(sundog::first_radius(context, parameters)),
      light_(context, parameters, parameters.text("direct") == "nee"),
      pool_(context.device, context.scene, std::max(light_.light_paths(), context.film.pixel_count())),
      camera(context.device, context.camera, context.filter, sampler_kind(parameters), context.scene.surface_options()),
      queries(context.device, context.scene, camera.count(), query_rules(parameters), parameters.text("direct") == "nee",
              sampler_kind(parameters))
{
    if (context.film.errors && !finds_laplacians) bias_.emplace(context, first_radius_);
}

void PhotonPass::trace(std::uint64_t iteration, float radius)
{
    const SamplerKey key = sampler_key(context_.seed, iteration);
    camera.start(context_.scene, pool_, key);
    if (context_.film.begin_first_hits(iteration)) camera.record_first_hits(context_.scene, pool_, iteration, context_.film.first_hits);
    queries.trace(context_.scene, camera, pool_, key, radius);
    light_.trace(pool_, key, bias_ ? bias_->map_radius(iteration, radius) : radius);
    radius_ = radius;
    iterations_++;
}

void PhotonPass::estimate_bias(int density_kernel)
{
    if (!bias_) return;
    bias_->add(light_.map, queries.queries, queries.lobes, iterations_ - 1, {density_kernel, 1.0f / static_cast<float>(light_paths())});
    context_.spectral.to_rgb(context_.film.errors->bias);
    // Sorting costs less than looking through wide cells, and the image stays what it is without errors to the last bit.
    light_.sort_again(radius_);
}

void PhotonPass::serialize(StateArchive& archive)
{
    archive.count("photon iterations", iterations_);
    archive.check(iterations_ == context_.film.iterations(), "photon iterations");
    light_.serialize(archive);
    pool_.serialize(archive);
}

MethodCounters PhotonPass::counters() const
{
    return {iterations_ * light_paths(), iterations_ * camera.count(), light_.photons_stored(), pool_.rays_traced()};
}

} // namespace sundog
