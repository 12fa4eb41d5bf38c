#include "stages/splat_tracer.h"

#include <algorithm>

namespace sundog {

SplatTracer::SplatTracer(Device& device, const DeviceScene& scene, const Camera& camera, std::size_t paths, std::size_t pixels, PathRules rules,
                         SamplerKind sampler)
    : device_(&device), path_count_(paths), pixels_(pixels), rules_(rules), flag_unoccluded_(device, "flag_unoccluded", "Flag free splats"),
      splat_pixel_keys_(device, "splat_pixel_keys", "Find splat pixels"), add_splats_(device, "add_splats", "Add splats"), shadow_(device, scene, paths, false),
      deposits_(device, paths, "splat deposits"), splats_(device, "splats", paths)
{
    BuildOptions options = scene.surface_options();
    use_sampler(options, sampler);
    emit_light_paths_ = Kernel(device, "emit_light_paths", "Emit light paths", options);
    use_camera(options, camera);
    shade_splat_path_ = Kernel(device, "shade_splat_path", "Shade splat paths", options);
}

void SplatTracer::trace_once(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, SamplerKey key)
{
    const uint count = static_cast<uint>(path_count_);
    splats_.clear();
    emit_light_paths_(count, scene.surfaces(), key, count, pool.rays, pool.paths, pool.active());
    pool.start(count);
    do {
        pool.trace(scene);
        shade_splat_path_(pool.items(), scene.surfaces(), camera.camera(), camera.filter(), key, rules_, count, pool.hits, pool.active(), pool.active_count(),
                          pool.rays, pool.paths, shadow_.rays, deposits_, pool.flags);
        shadow_.trace(scene, pool);
        flag_unoccluded_(pool.items(), pool.active(), pool.active_count(), shadow_.occluded, pool.flags);
        splats_.append(pool.compaction, deposits_, pool.flags, pool.active_count(), pool.items());
    } while (pool.keep_alive());
}

void SplatTracer::trace(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, SamplerKey key)
{
    trace_once(scene, camera, pool, key);
    std::size_t stored = splats_.read_count();
    if (stored > splats_.capacity()) {
        splats_.grow(stored); // the same key gives the same splats again
        trace_once(scene, camera, pool, key);
        stored = splats_.read_count();
    }
    reserve_sort();
    splat_pixel_keys_(stored, splats_.records(), splats_.count(), sort_->keys);
    sort_->sort(splats_.count(), stored, static_cast<uint>(std::max<std::size_t>(pixels_, 2)));
    add_splats_(pixels_, splats_.records(), sort_->order(), sort_->ends(), sort_->ends_offset(), static_cast<uint>(pixels_),
                1.0f / static_cast<float>(path_count_), camera.radiance);
}

void SplatTracer::reserve_sort()
{
    if (sort_ && sort_->capacity() >= splats_.capacity()) return;
    sort_.reset();
    sort_ = std::make_unique<KeySort>(*device_, splats_.capacity(), static_cast<uint>(std::max<std::size_t>(pixels_, 2)));
}

} // namespace sundog
