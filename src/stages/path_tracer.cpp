#include "stages/path_tracer.h"

namespace sundog
{

PathTracer::PathTracer(Device& device, const DeviceScene& scene, std::size_t paths, PathRules rules, SamplerKind sampler, bool regularized)
    : rules_(rules), shadow_(device, scene, paths, true)
{
    BuildOptions options = scene.surface_options();
    use_sampler(options, sampler);
    if (regularized) use_regularization(options);
    shade_camera_path_ = Kernel(device, "shade_camera_path", "Shade camera paths", options);
}

void PathTracer::trace(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, const SamplerSource& numbers,
                       Regularization regularization)
{
    for (;;) {
        shade_camera_path_(pool.items(), scene.surfaces(), numbers, rules_, regularization, pool.hits, pool.active(), pool.active_count(),
                           pool.rays, pool.paths, camera.radiance, shadow_.rays, shadow_.radiance, pool.flags);
        shadow_.trace(scene, pool);
        shadow_.add_unoccluded(pool, camera.radiance);
        if (!pool.keep_alive()) return;
        pool.trace(scene);
    }
}

} // namespace sundog
