#include "stages/light_paths.h"

#include <cassert>

namespace sundog {

PhotonTracer::PhotonTracer(Device& device, const DeviceScene& scene, const PhotonTracerSettings& settings)
    : settings_(settings), photons_(device, "photons", settings.paths)
{
    BuildOptions options = scene.surface_options();
    use_sampler(options, settings.sampler);
    emit_light_paths_ = Kernel(device, "emit_light_paths", "Emit light paths", options);
    options.defines.emplace_back("DIRECT_LIGHT", settings.direct_light_elsewhere ? "1" : "0");
    options.defines.emplace_back("PHOTONS_KEPT", std::to_string(static_cast<int>(settings.kept)));
    shade_photon_path_ = Kernel(device, "shade_photon_path", "Shade photon paths", options);
}

void PhotonTracer::trace_once(const DeviceScene& scene, PathPool& pool, SamplerKey key, Buffer<Photon>& deposits)
{
    const uint count = static_cast<uint>(settings_.paths);
    photons_.clear();
    emit_light_paths_(count, scene.surfaces(), key, count, pool.rays, pool.paths, pool.active());
    pool.start(count);
    do {
        pool.trace(scene);
        shade_photon_path_(pool.items(), scene.surfaces(), key, settings_.rules, count, pool.hits, pool.active(), pool.active_count(), pool.rays, pool.paths,
                           deposits, pool.flags);
        photons_.append(pool.compaction, deposits, pool.flags, pool.active_count(), pool.items());
    } while (pool.keep_alive());
}

std::size_t PhotonTracer::trace(const DeviceScene& scene, PathPool& pool, SamplerKey key, Buffer<Photon>& deposits)
{
    assert(deposits.size() >= settings_.paths);
    const std::uint64_t rays_before = pool.rays_traced();
    trace_once(scene, pool, key, deposits);
    std::size_t stored = photons_.read_count();
    if (stored > photons_.capacity()) {
        // Paths are a pure function of the key: the same photons come again, with room for all.
        photons_.grow(stored);
        pool.uncount_rays_since(rays_before);
        trace_once(scene, pool, key, deposits);
        stored = photons_.read_count();
    }
    return stored;
}

} // namespace sundog
