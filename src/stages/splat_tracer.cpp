#include "stages/splat_tracer.h"

namespace sundog {

SplatTracer::SplatTracer(Device& device, const DeviceScene& scene, const Camera& camera, std::size_t paths, std::size_t pixels, PathRules rules,
                         SamplerKind sampler)
    : path_count_(paths), rules_(rules), splats_(device, scene, paths, pixels)
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
                          pool.rays, pool.paths, splats_.shadow_rays(), splats_.deposits, pool.flags);
        splats_.collect(scene, pool);
    } while (pool.keep_alive());
}

void SplatTracer::trace(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, SamplerKey key)
{
    const std::uint64_t rays_before = pool.rays_traced();
    do {
        pool.uncount_rays_since(rays_before);
        trace_once(scene, camera, pool, key); // the same key gives the same splats again
    } while (!splats_.complete());
    splats_.add_to(camera.radiance);
}

} // namespace sundog
