// Queries answered by the photon map.
#pragma once

#include "stages/photon_map.h"

namespace sundog {

class PhotonGather {
public:
    // estimator: an embedded header, such as "estimators/radiance_estimate.h"; density_kernel: n of (1 - t^2)^n.
    PhotonGather(Device& device, std::size_t capacity, std::string estimator, int density_kernel)
        : sums(device, capacity, "gathered sums"),
          gather_photons_(device, "gather_photons", "Gather photons", {{{"DENSITY_KERNEL", std::to_string(density_kernel)}}, {std::move(estimator)}})
    {
    }

    void gather(const PhotonMap& map, const Buffer<GatherQuery>& queries, std::size_t count)
    {
        gather_photons_(count, map.grid(), map.cell_ends(), map.cell_ends_offset(), map.streams(), queries, static_cast<uint>(count), sums);
    }

    Buffer<GatherSum> sums; // by query: what the estimator's estimator_end returns

private:
    Kernel gather_photons_;
};

} // namespace sundog
