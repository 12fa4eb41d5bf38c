// Paths under way: their rays, hits and state, and the list of those still alive. Camera and light paths take
// turns in one pool.
#pragma once

#include "base/state_archive.h"
#include "shared/ray.h"
#include "stages/compaction.h"
#include "stages/device_scene.h"

#include <utility>

namespace sundog {

class PathPool {
public:
    PathPool(Device& device, const DeviceScene& scene, std::size_t capacity);

    Buffer<Ray> rays;
    Buffer<Hit> hits;
    Buffer<PathState> paths;
    Buffer<uint> flags; // by place in the active list; written by shading stages
    Compaction compaction;

    // The active list. A generating stage fills it with 0 .. count-1.
    Buffer<uint>& active() { return active_; }
    const Buffer<uint>& active_count() const { return active_count_; }
    std::size_t items() const { return items_; } // *active_count, as the host knows it

    void start(std::size_t count); // after paths 0 .. count-1 were generated

    // One step: finds the hits of all active paths.
    void trace(const DeviceScene& scene);

    // Drops the paths whose flag has no PATH_ALIVE. Waits, to learn how many are left. False: none.
    bool keep_alive();

    std::uint64_t rays_traced() const { return rays_traced_; }
    std::size_t capacity() const { return capacity_; }

    // Of what outlives an iteration there is only the count.
    void serialize(StateArchive& archive) { archive.count("rays traced", rays_traced_); }

private:
    std::size_t capacity_;
    Kernel trace_closest_;
    Buffer<uint> active_, next_active_;
    Buffer<uint> active_count_, next_active_count_;
    std::size_t items_ = 0;
    std::uint64_t rays_traced_ = 0;
};

// Shadow rays of a pool's paths, one a path at a time, and what each would bring.
class ShadowRays {
public:
    ShadowRays(Device& device, const DeviceScene& scene, std::size_t capacity, bool with_radiance);

    Buffer<Ray> rays;
    Buffer<Vec3> radiance; // empty without `with_radiance`
    Buffer<uint> occluded;

    void trace(const DeviceScene& scene, PathPool& pool);
    // target[path] += radiance[path] where the ray is free.
    void add_unoccluded(PathPool& pool, Buffer<Vec3>& target);

private:
    Kernel trace_any_;
    Kernel add_unoccluded_;
};

} // namespace sundog
