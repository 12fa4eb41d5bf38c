#include "stages/camera_subpaths.h"

#include "stages/regularization.h"

namespace sundog
{

CameraSubpaths::CameraSubpaths(Device& device, const DeviceScene& scene, const Camera& camera, std::size_t count, PathRules rules,
                               SamplerKind sampler, bool connects, bool regularized)
    : vertices(device, count, "camera vertices"), rules_(rules), connects_(connects), subpaths_(device, count, "camera subpaths"),
      shadow_(device, scene, count, true)
{
    BuildOptions options = scene.surface_options();
    use_sampler(options, sampler);
    use_camera(options, camera);
    if (regularized) use_regularization(options);
    shade_camera_subpath_ = Kernel(device, "shade_camera_subpath", "Shade camera subpaths", options);
}

void CameraSubpaths::shade(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, const SamplerSource& numbers,
                           Techniques techniques, Regularization regularization)
{
    shade_camera_subpath_(pool.items(), scene.surfaces(), camera.camera(), numbers, rules_, techniques, regularization, pool.hits,
                          pool.active(), pool.active_count(), pool.rays, pool.paths, subpaths_, camera.radiance, shadow_.rays,
                          shadow_.radiance, vertices, pool.flags);
    if (!connects_) return;
    shadow_.trace(scene, pool);
    shadow_.add_unoccluded(pool, camera.radiance);
}

} // namespace sundog
