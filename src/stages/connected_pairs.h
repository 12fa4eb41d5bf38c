// Pairs of a camera vertex and a light vertex: what light each brings, some at a time.
#pragma once

#include "stages/camera_subpaths.h"
#include "stages/light_subpaths.h"

namespace sundog
{

// What is connected.
struct ConnectedSubpaths {
    PathPool& pool; // whose flags say which paths left a vertex
    const CameraSubpaths& camera_subpaths;
    const LightSubpaths& light_subpaths;
    SamplerKey key;
};

class ConnectedPairs
{
public:
    // paths: of the camera. capacity: pairs at a time, so that memory is bounded.
    ConnectedPairs(Device& device, const DeviceScene& scene, std::size_t paths, std::size_t capacity, PathRules rules);

    Buffer<VertexPair> pairs;
    Buffer<uint> firsts; // each item's first place; and the end after the last
    // Of each pair: its radiance, weighted against all other ways to make the path, and whether something is between its vertices.
    Buffer<Vec3> radiance;
    Buffer<uint> occluded;

    std::size_t capacity() const { return pairs.size(); }
    const Buffer<uint>& all() const { return all_; } // 0 .. capacity() - 1
    const Buffer<uint>& count() const { return count_; }

    // Connects the first `count` pairs. scale: of each one's radiance.
    void connect(const DeviceScene& scene, const ConnectedSubpaths& subpaths, float scale, std::size_t count);

    // Adds what they bring to the radiance of their paths. window: the first one's place.
    void add_to(Buffer<Vec3>& target, PathPool& pool, std::size_t window, std::size_t count);

private:
    PathRules rules_;
    Kernel connect_vertices_, add_connections_, trace_any_;
    Buffer<uint> all_, count_;
    Buffer<Ray> shadow_rays_;
};

} // namespace sundog
