// Light vertices near the surfaces that camera subpaths have found, for connecting the vertices before those to them.
#pragma once

#include "stages/connection_list.h"
#include "stages/photon_map.h"

namespace sundog
{

class NearPhotons final : public ConnectionList
{
public:
    // paths: of the camera.
    NearPhotons(Device& device, const DeviceScene& scene, std::size_t paths);

    // Sorts the photons of traced light subpaths.
    void build(const LightSubpaths& light, float radius);

    // Of paths whose rays have been traced and not been shaded.
    std::size_t count(const ConnectedSubpaths& subpaths) override;
    void list(const ConnectedSubpaths& subpaths, std::size_t window, Buffer<uint>& firsts, Buffer<VertexPair>& pairs) override;

    float radius() const { return radius_; }

private:
    Device* device_;
    float radius_ = 0.0f;
    PhotonMap map_;
    Kernel order_slots_, count_near_photons_, sum_item_counts_, scan_counts_, place_items_, list_near_photons_;
    Buffer<uint> slots_, item_counts_, chunk_counts_, total_;
};

} // namespace sundog
