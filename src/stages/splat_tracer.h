// Light paths whose vertices are connected to the camera.
#pragma once

#include "shared/film.h"
#include "stages/camera_paths.h"
#include "stages/key_sort.h"

#include <memory>

namespace sundog {

class SplatTracer {
public:
    // paths: light subpaths an iteration.
    SplatTracer(Device& device, const DeviceScene& scene, const Camera& camera, std::size_t paths, std::size_t pixels, PathRules rules, SamplerKind sampler);

    // Traces one iteration's light paths and adds what reaches the lens to the camera's radiance. Splats are
    // sorted by pixel and added in path order: the same bits every time.
    void trace(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, SamplerKey key);

    void serialize(StateArchive& archive) { splats_.serialize(archive); }

private:
    void trace_once(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, SamplerKey key);
    void reserve_sort();

    Device* device_;
    std::size_t path_count_;
    std::size_t pixels_;
    PathRules rules_;
    Kernel emit_light_paths_, shade_splat_path_, flag_unoccluded_, splat_pixel_keys_, add_splats_;
    ShadowRays shadow_;
    Buffer<Splat> deposits_;
    RecordList<Splat> splats_;
    std::unique_ptr<KeySort> sort_;
};

} // namespace sundog
