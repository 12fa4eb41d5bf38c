#include "stages/vertex_connections.h"

#include <algorithm>
#include <numeric>

namespace sundog
{

namespace
{

constexpr std::size_t pairs_per_path = 4;

std::vector<uint> first_numbers(std::size_t count)
{
    std::vector<uint> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

} // namespace

VertexConnections::VertexConnections(Device& device, const DeviceScene& scene, std::size_t paths, PathRules rules,
                                     std::unique_ptr<ConnectionList> list)
    : rules_(rules), list_(std::move(list)), connect_vertices_(device, "connect_vertices", "Connect vertices", scene.surface_options()),
      add_connections_(device, "add_connections", "Add connections"),
      trace_any_(device, "trace_any", "Trace shadow rays", scene.trace_options()),
      pairs_(device, pairs_per_path * paths, "connected vertices"), firsts_(device, paths + 1, "first connections"),
      all_(device, first_numbers(pairs_.size()), "connection numbers"), count_(device, 1, "connection count"),
      shadow_rays_(device, pairs_.size(), "shadow rays"), radiance_(device, pairs_.size(), "connected radiance"),
      occluded_(device, pairs_.size(), "shadow results")
{
}

void VertexConnections::connect(const DeviceScene& scene, const ConnectedSubpaths& subpaths, Techniques techniques, Buffer<Vec3>& radiance)
{
    const PathPool& pool = subpaths.pool;
    const std::size_t total = list_->count(subpaths);
    for (std::size_t window = 0; window < total; window += pairs_.size()) {
        const std::size_t count = std::min(pairs_.size(), total - window);
        list_->list(subpaths, window, firsts_, pairs_);
        connect_vertices_(count, scene.surfaces(), rules_, techniques, list_->scale(subpaths.light_subpaths), static_cast<uint>(count),
                          pairs_, subpaths.camera_subpaths.vertices, subpaths.light_subpaths.vertices(), shadow_rays_, radiance_);
        count_.fill(static_cast<uint>(count));
        trace_any_(count, scene.geometry(), shadow_rays_, all_, count_, occluded_);
        add_connections_(pool.items(), subpaths.pool.active(), pool.active_count(), firsts_, static_cast<uint>(window),
                         static_cast<uint>(count), occluded_, radiance_, radiance);
    }
}

} // namespace sundog
