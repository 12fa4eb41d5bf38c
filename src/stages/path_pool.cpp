#include "stages/path_pool.h"

namespace sundog {

PathPool::PathPool(Device& device, const DeviceScene& scene, std::size_t capacity)
    : rays(device, capacity, "path rays"), hits(device, capacity, "path hits"), paths(device, capacity, "path states"), flags(device, capacity, "path flags"),
      compaction(device, capacity), capacity_(capacity), trace_closest_(device, "trace_closest", "Trace rays", scene.trace_options()),
      active_(device, capacity, "active paths"), next_active_(device, capacity, "active paths"), active_count_(device, 1, "active count"),
      next_active_count_(device, 1, "active count")
{
}

void PathPool::start(std::size_t count)
{
    active_count_.fill(static_cast<uint>(count));
    items_ = count;
}

void PathPool::trace(const DeviceScene& scene)
{
    trace_closest_(items_, scene.geometry(), rays, hits, active_, active_count_);
    rays_traced_ += items_;
}

bool PathPool::keep_alive()
{
    compaction.keep(active_, flags, active_count_, items_, PATH_ALIVE, next_active_, next_active_count_);
    std::swap(active_, next_active_);
    std::swap(active_count_, next_active_count_);
    items_ = active_count_.read(0);
    return items_ > 0;
}

ShadowRays::ShadowRays(Device& device, const DeviceScene& scene, std::size_t capacity, bool with_radiance)
    : rays(device, capacity, "shadow rays"), occluded(device, capacity, "shadow results"),
      trace_any_(device, "trace_any", "Trace shadow rays", scene.trace_options())
{
    if (!with_radiance) return;
    radiance = Buffer<Vec3>(device, capacity, "shadow ray radiance");
    add_unoccluded_ = Kernel(device, "add_unoccluded", "Add direct light");
}

void ShadowRays::trace(const DeviceScene& scene, PathPool& pool)
{
    trace_any_(pool.items(), scene.geometry(), rays, pool.active(), pool.active_count(), occluded);
}

void ShadowRays::add_unoccluded(PathPool& pool, Buffer<Vec3>& target)
{
    add_unoccluded_(pool.items(), pool.active(), pool.active_count(), occluded, radiance, target);
}

} // namespace sundog
