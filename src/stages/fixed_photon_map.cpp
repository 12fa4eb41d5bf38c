#include "stages/fixed_photon_map.h"

#include <algorithm>

namespace sundog
{

FixedPhotonMap::FixedPhotonMap(Device& device, const DeviceScene& scene, std::size_t capacity, const PhotonLookup& lookup,
                               const std::vector<Photon>& photons, std::uint64_t light_paths, bool sorts_again)
    : lookup_(lookup), inverse_paths_(1.0f / static_cast<float>(light_paths)), map_(device, scene.bounds()),
      records_(std::in_place, device, "photons", std::max<std::size_t>(photons.size(), 1)),
      gather_(device, capacity, "estimators/radiance_estimate.h", lookup.density_kernel,
              scene.has_lobes_to_evaluate() ? std::optional(scene.surface_options()) : std::nullopt, lookup.nearest > 0),
      add_gathered_(device, "add_gathered", "Add gathered light")
{
    records_->assign(photons);
    if (lookup.nearest > 0) {
        map_.build_dense(*records_, photons.size(), lookup.usual_radius);
        set_radii_ = Kernel(device, "find_nearest_radii", "Find nearest photons",
                            BuildOptions{{{"NEAREST", std::to_string(lookup.nearest) + "u"}}, {}});
    } else {
        map_.build(*records_, photons.size(), lookup.radius);
        set_radii_ = Kernel(device, "set_query_radius", "Set query radius");
    }
    if (sorts_again) return;
    device.finish(); // the records go
    records_.reset();
}

void FixedPhotonMap::sort_again(float radius)
{
    map_.build(*records_, records_->read_count(), radius);
}

void FixedPhotonMap::add_radiance(Buffer<GatherQuery>& queries, const Buffer<LobeRecord>& lobes, Buffer<Vec3>& radiance)
{
    const uint count = static_cast<uint>(queries.size());
    if (lookup_.nearest > 0)
        set_radii_(count, map_, lookup_.usual_radius, lookup_.radius,
                   count, queries);
    else
        set_radii_(count, lookup_.radius, count, queries);
    gather_.gather(map_, queries, lobes, count);
    add_gathered_(count, queries, gather_.sums, count, inverse_paths_, radiance);
}

} // namespace sundog
