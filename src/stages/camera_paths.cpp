#include "stages/camera_paths.h"

namespace sundog
{

namespace
{

// Rays take nothing of surfaces but whether they pass lights.
BuildOptions ray_options(const Camera& camera, SamplerKind sampler, const BuildOptions& surface_options)
{
    BuildOptions options;
    use_camera(options, camera);
    use_sampler(options, sampler);
    for (const auto& define : surface_options.defines)
        if (define.first == "HIDE_EMITTERS") options.defines.push_back(define);
    return options;
}

} // namespace

CameraPaths::CameraPaths(Device& device, const Camera& camera, const PixelFilter& filter, std::size_t count)
    : radiance(device, count, "radiance"), camera_(camera), count_(count), filter_(device, std::vector{filter}, "pixel filter")
{
}

CameraPaths::CameraPaths(Device& device, const Camera& camera, const PixelFilter& filter, SamplerKind sampler,
                         const BuildOptions& surface_options)
    : CameraPaths(device, camera, filter, static_cast<std::size_t>(camera.crop_width) * static_cast<std::size_t>(camera.crop_height))
{
    BuildOptions first_hit_options = surface_options;
    use_camera(first_hit_options, camera);
    record_first_hits_ = Kernel(device, "record_first_hits", "Record first hits", first_hit_options);
    BuildOptions options = ray_options(camera, sampler, surface_options);
    generate_camera_rays_ = Kernel(device, "generate_camera_rays", "Generate camera rays", options);
}

CameraPaths CameraPaths::anywhere(Device& device, const Camera& camera, const PixelFilter& filter, SamplerKind sampler, std::size_t count,
                                  const BuildOptions& surface_options)
{
    CameraPaths paths(device, camera, filter, count);
    paths.pixels = Buffer<uint>(device, count, "path pixels");
    BuildOptions options = ray_options(camera, sampler, surface_options);
    paths.generate_camera_rays_ = Kernel(device, "generate_film_rays", "Generate camera rays", options);
    return paths;
}

void CameraPaths::start(const DeviceScene& scene, PathPool& pool, const SamplerSource& numbers)
{
    const uint count = static_cast<uint>(count_);
    if (pixels)
        generate_camera_rays_(count_, camera_, filter_, numbers, count, pool.rays, pool.paths, radiance, pool.active(), pixels);
    else
        generate_camera_rays_(count_, camera_, filter_, numbers, count, pool.rays, pool.paths, radiance, pool.active());
    pool.start(count_);
    pool.trace(scene);
}

void CameraPaths::record_first_hits(const DeviceScene& scene, PathPool& pool, std::uint64_t iteration, Buffer<FirstHitPixel>& first_hits)
{
    record_first_hits_(count_, scene.surfaces(), pool.rays, pool.hits, camera_, static_cast<uint>(count_), static_cast<uint>(iteration),
                       first_hits);
}

} // namespace sundog
