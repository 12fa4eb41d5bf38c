#include "stages/camera_paths.h"

namespace sundog {

CameraPaths::CameraPaths(Device& device, const Camera& camera, const PixelFilter& filter, SamplerKind sampler, const BuildOptions& surface_options)
    : camera_(camera), count_(static_cast<std::size_t>(camera.crop_width) * static_cast<std::size_t>(camera.crop_height)),
      filter_(device, std::vector{filter}, "pixel filter")
{
    radiance = Buffer<Vec3>(device, count_, "radiance");
    BuildOptions first_hit_options = surface_options;
    use_camera(first_hit_options, camera);
    record_first_hits_ = Kernel(device, "record_first_hits", "Record first hits", first_hit_options);
    BuildOptions options;
    use_camera(options, camera);
    use_sampler(options, sampler);
    generate_camera_rays_ = Kernel(device, "generate_camera_rays", "Generate camera rays", options);
}

void CameraPaths::start(const DeviceScene& scene, PathPool& pool, SamplerKey key)
{
    generate_camera_rays_(count_, camera_, filter_, key, static_cast<uint>(count_), pool.rays, pool.paths, radiance, pool.active());
    pool.start(count_);
    pool.trace(scene);
}

void CameraPaths::record_first_hits(const DeviceScene& scene, PathPool& pool, std::uint64_t iteration, Buffer<FirstHitPixel>& first_hits)
{
    record_first_hits_(count_, scene.surfaces(), pool.rays, pool.hits, camera_, static_cast<uint>(count_), static_cast<uint>(iteration), first_hits);
}

} // namespace sundog
