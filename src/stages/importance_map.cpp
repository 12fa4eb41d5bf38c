#include "stages/importance_map.h"

#include <algorithm>

namespace sundog
{

namespace
{

// Photons survive for certain where importons are at least half as dense as they would be if they were spread evenly over a
// sphere around the scene; nowhere with a smaller probability than `least_survival`, which bounds how bright one can become.
constexpr float enough_of_even = 0.5f;
constexpr float least_survival = 0.1f;

} // namespace

ImportanceMap::ImportanceMap(Device& device, const DeviceScene& scene, std::size_t capacity, std::size_t importons, float radius)
    : capacity_(capacity), radius_(radius), scene_radius_(scene.radius()), leave_importons_(device, "leave_importons", "Leave importons"),
      query_photons_(device, "query_photons", "Query photons"), thin_photons_(device, "thin_photons", "Thin photons"),
      compaction_(device, capacity), queries_(device, capacity, "importance queries"), no_lobes_(device, 1, "query lobes"),
      deposits_(device, capacity, "importance deposits"), flags_(device, capacity, "importance flags"),
      item_count_(device, std::vector{static_cast<uint>(capacity)}, "importance items"), importons_(device, "importons", importons),
      survivors_(device, "surviving photons", capacity), map_(device, scene.bounds()), gather_(device, capacity, "estimators/flux_sum.h", 0)
{
    importons_.clear();
}

void ImportanceMap::add(const Buffer<GatherQuery>& queries)
{
    leave_importons_(capacity_, queries, static_cast<uint>(capacity_), deposits_, flags_);
    importons_.append(compaction_, deposits_, flags_, item_count_, capacity_);
}

void ImportanceMap::build()
{
    const std::size_t count = importons_.read_count();
    map_.build(importons_, count, radius_);
    const float share = radius_ / (2.0f * scene_radius_); // r^2 / (4 R^2) of the sphere
    enough_ = std::max(enough_of_even * static_cast<float>(count) * share * share, 1.0f);
}

std::vector<Photon> ImportanceMap::thin(const RecordList<Photon>& photons, std::size_t count, SamplerKey key)
{
    if (survivors_.capacity() < count) survivors_.grow(count);
    survivors_.clear();
    const uint batch = static_cast<uint>(capacity_), all = static_cast<uint>(count);
    for (std::size_t done = 0; done < count; done += capacity_) {
        const uint first = static_cast<uint>(done);
        query_photons_(capacity_, photons.records(), first, all, radius_, batch, queries_);
        gather_.gather(map_, queries_, no_lobes_, capacity_);
        thin_photons_(capacity_, photons.records(), first, all, gather_.sums, key, enough_, least_survival, batch, deposits_, flags_);
        survivors_.append(compaction_, deposits_, flags_, item_count_, capacity_);
    }
    return survivors_.records().download(0, survivors_.read_count());
}

} // namespace sundog
