#include "methods/traced_photons.h"

namespace sundog
{

namespace
{

// Paths in flight: some 150 bytes each.
constexpr std::size_t largest_batch = std::size_t(1) << 18;

} // namespace

TracedPhotons trace_photons(RenderContext& context, PhotonTracerSettings settings, uint map_number)
{
    TracedPhotons traced;
    const std::size_t batches = (settings.paths + largest_batch - 1) / largest_batch;
    settings.paths = (settings.paths + batches - 1) / batches;
    PathPool pool(context.device, context.scene, settings.paths);
    PhotonTracer tracer(context.device, context.scene, settings);
    for (std::size_t batch = 0; batch < batches; batch++) {
        // Batches continue the points of one sequence; above 2^32 another begins (kernels/math/sampler.h).
        const SamplerKey key = sampler_key(context.seed, (static_cast<std::uint64_t>(map_number) << 32) + batch);
        const std::size_t stored = tracer.trace(context.scene, pool, key);
        const std::vector<Photon> photons = tracer.photons().records().download(0, stored);
        traced.photons.insert(traced.photons.end(), photons.begin(), photons.end());
    }
    traced.light_paths = batches * settings.paths;
    traced.rays = pool.rays_traced();
    return traced;
}

} // namespace sundog
