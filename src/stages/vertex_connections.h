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
    void connect(const DeviceScene& scene, const ConnectedSubpaths& subpaths, Buffer<Vec3>& radiance);

private:
    std::unique_ptr<ConnectionList> list_;
    ConnectedPairs pairs_;
};

} // namespace sundog
