#include "stages/connected_pairs.h"

#include <numeric>

namespace sundog
{

namespace
{

std::vector<uint> first_numbers(std::size_t count)
{
    std::vector<uint> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

} // namespace

ConnectedPairs::ConnectedPairs(Device& device, const DeviceScene& scene, std::size_t paths, std::size_t capacity, PathRules rules)
    : pairs(device, capacity, "connected vertices"), firsts(device, paths + 1, "first connections"),
      radiance(device, capacity, "connected radiance"), occluded(device, capacity, "shadow results"), rules_(rules),
      connect_vertices_(device, "connect_vertices", "Connect vertices", scene.surface_options()),
      add_connections_(device, "add_connections", "Add connections"),
      trace_any_(device, "trace_any", "Trace shadow rays", scene.trace_options()),
      all_(device, first_numbers(capacity), "connection numbers"), count_(device, 1, "connection count"),
      shadow_rays_(device, capacity, "shadow rays")
{
}

void ConnectedPairs::connect(const DeviceScene& scene, const ConnectedSubpaths& subpaths, float scale, std::size_t count)
{
    connect_vertices_(count, rules_, scale, static_cast<uint>(count), pairs, subpaths.camera_subpaths.vertices,
                      subpaths.light_subpaths.vertices(), shadow_rays_, radiance);
    count_.fill(static_cast<uint>(count));
    trace_any_(count, scene.geometry(), shadow_rays_, all_, count_, occluded);
}

void ConnectedPairs::add_to(Buffer<Vec3>& target, PathPool& pool, std::size_t window, std::size_t count)
{
    add_connections_(pool.items(), pool.active(), pool.active_count(), firsts, static_cast<uint>(window), static_cast<uint>(count), occluded,
                     radiance, target);
}

} // namespace sundog
