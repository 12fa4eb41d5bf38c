// Light paths whose vertices are connected to the camera.
#pragma once

#include "stages/camera_paths.h"
#include "stages/lens_splats.h"

namespace sundog {

class SplatTracer {
public:
    // paths: light subpaths an iteration.
    SplatTracer(Device& device, const DeviceScene& scene, const Camera& camera, std::size_t paths, std::size_t pixels, PathRules rules, SamplerKind sampler);

    // Traces one iteration's light paths and adds what reaches the lens to the camera's radiance.
    void trace(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, SamplerKey key);

    void serialize(StateArchive& archive) { splats_.serialize(archive); }

private:
    void trace_once(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, SamplerKey key);

    std::size_t path_count_;
    PathRules rules_;
    Kernel emit_light_paths_, shade_splat_path_;
    LensSplats splats_;
};

} // namespace sundog
