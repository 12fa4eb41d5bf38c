// A photon map that stays: built once from given photons, asked by many queries with one radius or for k nearest photons.
#pragma once

#include "shared/bsdf.h"
#include "stages/photon_gather.h"

namespace sundog
{

// Which photons a query finds.
struct PhotonLookup {
    float radius = 0.0f;       // of queries; with `nearest` the largest (scene units)
    uint nearest = 0;          // k > 0: as near as the k-th photon, which does not count itself; 0: within the radius
    float usual_radius = 0.0f; // where the search for k begins
    int density_kernel = 0;    // as DENSITY_KERNEL
    bool relaxed = false;      // the photons keep away from each other (photon_relaxation.h)
};

// How much of the k-th photon counts in a relaxed map, over what it would by the kernel's mean.
float share_of_kth_photon(int density_kernel);

class FixedPhotonMap
{
public:
    // light_paths: how many emitted subpaths left the photons. capacity: of queries. sorts_again: whether it will be asked to.
    FixedPhotonMap(Device& device, const DeviceScene& scene, std::size_t capacity, const PhotonLookup& lookup,
                   const std::vector<Photon>& photons, std::uint64_t light_paths, bool sorts_again = false);

    // radiance[i] += what query i finds (W/m^2/sr). The queries' radii become those of the lookup.
    void add_radiance(Buffer<GatherQuery>& queries, const Buffer<LobeRecord>& lobes, Buffer<Vec3>& radiance);

    // Sorts the photons for other queries than those of add_radiance(), of at most another radius, and ends the map for these.
    void sort_again(float radius);

    const PhotonLookup& lookup() const { return lookup_; }
    const PhotonMap& photons() const { return map_; }
    float inverse_paths() const { return inverse_paths_; }
    std::size_t capacity() const { return gather_.sums.size(); } // most queries at once

private:
    PhotonLookup lookup_;
    float inverse_paths_;
    PhotonMap map_;
    std::optional<RecordList<Photon>> records_; // where it sorts again
    PhotonGather<> gather_;
    Kernel set_radii_;
    Kernel add_gathered_;
};

} // namespace sundog
