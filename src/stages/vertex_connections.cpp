#include "stages/vertex_connections.h"

#include <algorithm>

namespace sundog
{

namespace
{

constexpr std::size_t pairs_per_path = 4;

} // namespace

VertexConnections::VertexConnections(Device& device, const DeviceScene& scene, std::size_t paths, PathRules rules,
                                     std::unique_ptr<ConnectionList> list)
    : list_(std::move(list)), pairs_(device, scene, paths, pairs_per_path * paths, rules)
{
}

void VertexConnections::connect(const DeviceScene& scene, const ConnectedSubpaths& subpaths, Buffer<Vec3>& radiance)
{
    const std::size_t total = list_->count(subpaths);
    for (std::size_t window = 0; window < total; window += pairs_.capacity()) {
        const std::size_t count = std::min(pairs_.capacity(), total - window);
        list_->list(subpaths, window, pairs_.firsts, pairs_.pairs);
        pairs_.connect(scene, subpaths, list_->scale(subpaths.light_subpaths), count);
        pairs_.add_to(radiance, subpaths.pool, window, count);
    }
}

} // namespace sundog
