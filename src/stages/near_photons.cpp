#include "stages/near_photons.h"

namespace sundog
{

NearPhotons::NearPhotons(Device& device, const DeviceScene& scene, std::size_t paths)
    : device_(&device), map_(device, scene.bounds(), true), order_slots_(device, "order_slots", "Lay out light vertices"),
      count_near_photons_(device, "count_near_photons", "Count near photons"),
      sum_item_counts_(device, "sum_item_counts", "Sum near photons"), scan_counts_(device, "scan_counts", "Scan counts"),
      place_items_(device, "place_items", "Place near photons"), list_near_photons_(device, "list_near_photons", "List near photons"),
      item_counts_(device, paths, "near photon counts"), chunk_counts_(device, Compaction::chunks_of(paths), "near photon chunk counts"),
      total_(device, 1, "near photons")
{
}

void NearPhotons::build(const LightSubpaths& light, float radius)
{
    radius_ = radius;
    map_.build(light.photons(), light.photons_stored(), radius);
    const std::size_t stride = map_.grid().stride;
    if (slots_.size() < stride) {
        slots_ = {}; // give back before asking for more
        slots_ = Buffer<uint>(*device_, stride, "light vertices in order");
    }
    order_slots_(light.photons_stored(), light.photon_vertices().records(), map_.order(), light.photons().count(), slots_);
}

std::size_t NearPhotons::count(const ConnectedSubpaths& s)
{
    const PathPool& pool = s.pool;
    const uint chunks = static_cast<uint>(Compaction::chunks_of(pool.items()));
    count_near_photons_(pool.items(), map_, slots_, radius_,
                        s.pool.active(), pool.active_count(), pool.paths, pool.rays, pool.hits, item_counts_);
    sum_item_counts_(chunks, item_counts_, pool.active_count(), chunks, chunk_counts_);
    scan_counts_.launch_grouped(1, 1, chunk_counts_, chunks, 0u, total_);
    return total_.read(0);
}

void NearPhotons::list(const ConnectedSubpaths& s, std::size_t window, Buffer<uint>& firsts, Buffer<VertexPair>& pairs)
{
    const PathPool& pool = s.pool;
    const uint chunks = static_cast<uint>(Compaction::chunks_of(pool.items()));
    place_items_(chunks, item_counts_, pool.active_count(), chunks, chunk_counts_, firsts);
    list_near_photons_(pool.items(), map_, slots_, radius_,
                       s.pool.active(), pool.active_count(), pool.rays, pool.hits, firsts, static_cast<uint>(window),
                       static_cast<uint>(pairs.size()), pairs);
}

} // namespace sundog
