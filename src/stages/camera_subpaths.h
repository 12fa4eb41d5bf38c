// Camera subpaths that light subpaths are joined to, bounce by bounce.
#pragma once

#include "shared/bidirectional.h"
#include "shared/regularization.h"
#include "stages/camera_paths.h"

namespace sundog
{

class CameraSubpaths
{
public:
    CameraSubpaths(Device& device, const DeviceScene& scene, const Camera& camera, std::size_t count, PathRules rules, SamplerKind sampler,
                   bool connects, bool regularized);

    // One vertex of each active path, with next-event estimation where there are connections. To be joined afterwards: those
    // whose flag has PATH_JOINS.
    void shade(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, const SamplerSource& numbers, Techniques techniques, Regularization regularization);

    Buffer<PathVertex> vertices; // of this bounce, by path

private:
    PathRules rules_;
    bool connects_;
    Kernel shade_camera_subpath_;
    Buffer<Subpath> subpaths_;
    ShadowRays shadow_;
};

} // namespace sundog
