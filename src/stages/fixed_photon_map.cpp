#include "stages/fixed_photon_map.h"

#include <algorithm>

namespace sundog
{

namespace
{

// Of relaxed photons the k-th is at the disk's edge not by chance alone.
bool counts_half(const PhotonLookup& lookup)
{
    return lookup.relaxed && lookup.nearest > 1;
}

} // namespace

float share_of_kth_photon(int density_kernel)
{
    // With the uniform kernel half of it: k - 1/2 photons lie in the disk. Others see less of the edge, where photons are missing: as
    // measured on even light after ten sweeps, with k = 10 and 30.
    constexpr float shares[] = {0.5f, 0.15f, 0.1f, 0.075f, 0.2f, 0.25f};
    return shares[density_kernel];
}

FixedPhotonMap::FixedPhotonMap(Device& device, const DeviceScene& scene, std::size_t capacity, const PhotonLookup& lookup,
                               const std::vector<Photon>& photons, std::uint64_t light_paths, bool sorts_again)
    : lookup_(lookup), inverse_paths_(1.0f / static_cast<float>(light_paths)), map_(device, scene.bounds()),
      records_(std::in_place, device, "photons", std::max<std::size_t>(photons.size(), 1)),
      gather_(device, capacity, "estimators/radiance_estimate.h", lookup.density_kernel,
              scene.has_lobes_to_evaluate() ? std::optional(scene.surface_options()) : std::nullopt, lookup.nearest > 0),
      add_gathered_(device, counts_half(lookup) ? "add_relaxed" : "add_gathered", "Add gathered light")
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
    if (counts_half(lookup_)) {
        const float scale = 1.0f + share_of_kth_photon(lookup_.density_kernel) / static_cast<float>(lookup_.nearest - 1);
        add_gathered_(count, queries, gather_.sums, count, inverse_paths_, lookup_.radius, scale, radiance);
    } else {
        add_gathered_(count, queries, gather_.sums, count, inverse_paths_, radiance);
    }
}

} // namespace sundog
