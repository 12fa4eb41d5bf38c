// Connections of camera vertices to light vertices.
#pragma once

#include "stages/camera_subpaths.h"
#include "stages/light_subpaths.h"

namespace sundog
{

class VertexConnections
{
public:
    // count: camera paths.
    VertexConnections(Device& device, const DeviceScene& scene, std::size_t count, PathRules rules);

    // Connects the vertices of this bounce, each to all of one light subpath, and adds what comes through to the radiance of
    // their paths.
    void connect(const DeviceScene& scene, PathPool& pool, const CameraSubpaths& camera, const LightSubpaths& light, SamplerKey key,
                 Techniques techniques, Buffer<Vec3>& radiance);

private:
    std::size_t capacity_; // pairs at a time, so that memory is bounded
    PathRules rules_;
    Kernel count_connections_, scan_counts_, list_connections_, connect_vertices_, add_connections_, trace_any_;
    Buffer<uint> chunk_counts_, total_, firsts_, all_, count_;
    Buffer<VertexPair> pairs_;
    Buffer<Ray> shadow_rays_;
    Buffer<Vec3> radiance_;
    Buffer<uint> occluded_;
};

} // namespace sundog
