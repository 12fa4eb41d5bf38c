#include "stages/light_subpaths.h"

namespace sundog
{

LightSubpaths::LightSubpaths(Device& device, const DeviceScene& scene, const Camera& camera, const LightSubpathSettings& settings)
    : device_(&device), settings_(settings), splats_(device, scene, settings.paths, settings.pixels),
      subpaths_(device, settings.paths, "light subpaths"), vertices_(device, settings.connects ? 4 * settings.paths : 1, "light vertices"),
      links_(device, vertices_.size(), "light vertex links"), last_vertices_(device, settings.paths, "last light vertices"),
      photon_deposits_(device, settings.merges ? settings.paths : 1, "photon deposits"),
      photon_vertex_deposits_(device, settings.merges ? settings.paths : 1, "photon vertex deposits"),
      photons_(device, "photons", settings.merges ? 2 * settings.paths : 1), photon_vertices_(device, "photon vertices", photons_.capacity())
{
    BuildOptions options = scene.surface_options();
    use_sampler(options, settings.sampler);
    emit_light_subpaths_ = Kernel(device, "emit_light_subpaths", "Emit light subpaths", options);
    use_camera(options, camera);
    shade_light_subpath_ = Kernel(device, "shade_light_subpath", "Shade light subpaths", options);
}

void LightSubpaths::reserve_slots(std::size_t slots)
{
    vertices_ = {}; // give back before asking for more
    links_ = {};
    vertices_ = Buffer<PathVertex>(*device_, slots, "light vertices");
    links_ = Buffer<VertexLink>(*device_, slots, "light vertex links");
}

// Vertices of earlier bounces are lost where there was none.
bool LightSubpaths::has_room_for(std::size_t slots)
{
    if (!settings_.connects || slots <= vertices_.size()) return true;
    reserve_slots(slots + slots / 2);
    return false;
}

// False: there was no room for a bounce, and there is now.
bool LightSubpaths::trace_once(const DeviceScene& scene, const CameraPaths& camera, PathPool& pool, const SamplerSource& numbers,
                               Techniques techniques)
{
    const uint count = static_cast<uint>(settings_.paths);
    slots_ = 0;
    splats_.clear();
    photons_.clear();
    photon_vertices_.clear();
    emit_light_subpaths_(count, scene.surfaces(), numbers, techniques, count, pool.rays, pool.paths, subpaths_, pool.active(), last_vertices_);
    pool.start(count);
    do {
        if (!has_room_for(slots_ + pool.items())) return false;
        pool.trace(scene);
        shade_light_subpath_(pool.items(), scene.surfaces(), camera.camera(), camera.filter(), numbers, settings_.rules, techniques, count,
                             static_cast<uint>(slots_), pool.hits, pool.active(), pool.active_count(), pool.rays, pool.paths, subpaths_,
                             vertices_, links_, last_vertices_, splats_.shadow_rays(), splats_.deposits, photon_deposits_, photon_vertex_deposits_,
                             pool.flags);
        slots_ += pool.items();
        if (settings_.connects) splats_.collect(scene, pool);
        if (settings_.merges) {
            photons_.append(pool.compaction, photon_deposits_, pool.flags, pool.active_count(), pool.items());
            photon_vertices_.append(pool.compaction, photon_vertex_deposits_, pool.flags, pool.active_count(), pool.items());
        }
    } while (pool.keep_alive());
    return (!settings_.merges || photons_complete()) && (!settings_.connects || splats_.complete());
}

bool LightSubpaths::photons_complete()
{
    photons_stored_ = photons_.read_count();
    if (photons_stored_ <= photons_.capacity()) return true;
    photons_.grow(photons_stored_);
    photon_vertices_.grow(photons_stored_);
    return false;
}

void LightSubpaths::trace(const DeviceScene& scene, const CameraPaths& camera, PathPool& pool, const SamplerSource& numbers,
                               Techniques techniques)
{
    // Subpaths are a pure function of the numbers: where there was no room the same ones come again.
    while (!trace_once(scene, camera, pool, numbers, techniques)) {
    }
}

void LightSubpaths::serialize(StateArchive& archive)
{
    splats_.serialize(archive);
    photons_.serialize(archive);
    photon_vertices_.serialize(archive);
    archive.check(photons_.capacity() == photon_vertices_.capacity(), "photon vertices capacity");
    // As with records: a resumed render would trace again what it has no room for, and count rays twice.
    std::uint64_t slots = vertices_.size();
    archive.capacity("light vertex slots", slots, sizeof(PathVertex), device_->info().largest_buffer_bytes);
    if (slots != vertices_.size()) reserve_slots(static_cast<std::size_t>(slots));
}

} // namespace sundog
