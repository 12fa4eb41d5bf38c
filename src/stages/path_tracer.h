// Camera paths with next-event estimation and BSDF sampling, from their first hits to their ends.
#pragma once

#include "stages/camera_paths.h"
#include "stages/regularization.h"

namespace sundog
{

class PathTracer
{
public:
    // paths: most at a time. regularized: with what specular vertices before a light add.
    PathTracer(Device& device, const DeviceScene& scene, std::size_t paths, PathRules rules, SamplerKind sampler, bool regularized = false);

    // Follows paths that the camera has started, and adds what they find to its radiance.
    void trace(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, const SamplerSource& numbers,
               Regularization regularization = {});

private:
    PathRules rules_;
    ShadowRays shadow_;
    Kernel shade_camera_path_;
};

} // namespace sundog
