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

VertexConnections::VertexConnections(Device& device, const DeviceScene& scene, std::size_t count, PathRules rules)
    : capacity_(pairs_per_path * count), rules_(rules), count_connections_(device, "count_connections", "Count connections"),
      scan_counts_(device, "scan_counts", "Scan counts"), list_connections_(device, "list_connections", "List connections"),
      connect_vertices_(device, "connect_vertices", "Connect vertices", scene.surface_options()),
      add_connections_(device, "add_connections", "Add connections"),
      trace_any_(device, "trace_any", "Trace shadow rays", scene.trace_options()),
      chunk_counts_(device, Compaction::chunks_of(count), "connection counts"), total_(device, 1, "connections"),
      firsts_(device, count + 1, "first connections"), all_(device, first_numbers(capacity_), "connection numbers"),
      count_(device, 1, "connection count"), pairs_(device, capacity_, "connected vertices"),
      shadow_rays_(device, capacity_, "shadow rays"), radiance_(device, capacity_, "connected radiance"),
      occluded_(device, capacity_, "shadow results")
{
}

void VertexConnections::connect(const DeviceScene& scene, PathPool& pool, const CameraSubpaths& camera, const LightSubpaths& light,
                                SamplerKey key, Techniques techniques, Buffer<Vec3>& radiance)
{
    const uint chunks = static_cast<uint>(Compaction::chunks_of(pool.items())), light_paths = static_cast<uint>(light.paths());
    count_connections_(chunks, key, light_paths, pool.active(), pool.active_count(), pool.flags, light.last_vertices(), light.links(),
                       chunks, chunk_counts_);
    scan_counts_.launch_grouped(1, 1, chunk_counts_, chunks, 0u, total_);
    const std::size_t total = total_.read(0);
    for (std::size_t window = 0; window < total; window += capacity_) {
        const std::size_t count = std::min(capacity_, total - window);
        list_connections_(chunks, key, light_paths, pool.active(), pool.active_count(), pool.flags, light.last_vertices(), light.links(),
                          chunks, chunk_counts_, static_cast<uint>(window), static_cast<uint>(capacity_), firsts_, pairs_);
        connect_vertices_(count, scene.surfaces(), rules_, techniques, static_cast<uint>(count), pairs_, camera.vertices, light.vertices(),
                          shadow_rays_, radiance_);
        count_.fill(static_cast<uint>(count));
        trace_any_(count, scene.geometry(), shadow_rays_, all_, count_, occluded_);
        add_connections_(pool.items(), pool.active(), pool.active_count(), firsts_, static_cast<uint>(window), static_cast<uint>(count),
                         occluded_, radiance_, radiance);
    }
}

} // namespace sundog
