// Camera paths: their start, what they see first, and the radiance they bring back.
#pragma once

#include "shared/camera.h"
#include "shared/film.h"
#include "stages/path_pool.h"
#include "stages/sampling.h"

namespace sundog
{

// Specialises kernels that make camera rays or connect to the camera.
inline void use_camera(BuildOptions& options, const Camera& camera)
{
    options.defines.emplace_back("CAMERA_KIND", std::to_string(camera.kind) + "u");
}

// One path a pixel of the crop, or any number of paths all over it.
class CameraPaths
{
public:
    // Keeps a reference to the camera, which may move from pass to pass.
    CameraPaths(Device& device, const Camera& camera, const PixelFilter& filter, SamplerKind sampler,
                const BuildOptions& surface_options = {});

    // `count` paths instead that start anywhere on the film, each at a pixel that its numbers name.
    static CameraPaths anywhere(Device& device, const Camera& camera, const PixelFilter& filter, SamplerKind sampler, std::size_t count,
                                const BuildOptions& surface_options);

    // Starts the pool's paths at the camera, finds their first hits, and clears `radiance`.
    void start(const DeviceScene& scene, PathPool& pool, const SamplerSource& numbers);

    // One path a pixel: adds the first hits to the albedo, normal and depth means; `iteration` counts from 0.
    void record_first_hits(const DeviceScene& scene, PathPool& pool, std::uint64_t iteration, Buffer<FirstHitPixel>& first_hits);

    Buffer<Vec3> radiance; // W/m^2/sr of this iteration, by path
    Buffer<uint> pixels;   // of paths anywhere, by path; in the film's order

    std::size_t count() const { return count_; }
    const Camera& camera() const { return camera_; }
    const Buffer<PixelFilter>& filter() const { return filter_; }

private:
    CameraPaths(Device& device, const Camera& camera, const PixelFilter& filter, std::size_t count);

    const Camera& camera_;
    std::size_t count_;
    Buffer<PixelFilter> filter_;
    Kernel generate_camera_rays_;
    Kernel record_first_hits_;
};

} // namespace sundog
