// Connections of camera vertices to light vertices.
#pragma once

#include "stages/connection_list.h"

namespace sundog
{

class VertexConnections
{
public:
    // paths: of the camera.
    VertexConnections(Device& device, const DeviceScene& scene, std::size_t paths, PathRules rules, std::unique_ptr<ConnectionList> list);

    // Connects the vertices of this bounce and adds what comes through to the radiance of their paths.
    void connect(const DeviceScene& scene, const ConnectedSubpaths& subpaths, Techniques techniques, Buffer<Vec3>& radiance);

private:
    PathRules rules_;
    std::unique_ptr<ConnectionList> list_;
    Kernel connect_vertices_, add_connections_, trace_any_;
    Buffer<VertexPair> pairs_; // some at a time, so that memory is bounded
    Buffer<uint> firsts_, all_, count_;
    Buffer<Ray> shadow_rays_;
    Buffer<Vec3> radiance_;
    Buffer<uint> occluded_;
};

} // namespace sundog
