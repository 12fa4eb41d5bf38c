// Queries answered by the photon map.
#pragma once

#include "shared/bsdf.h"
#include "stages/photon_map.h"

#include <optional>

namespace sundog {

// Result: what the estimator's estimator_end returns.
template <class Result = GatherSum> class PhotonGather {
public:
    // estimator: an embedded header, such as "estimators/radiance_estimate.h"; density_kernel: as DENSITY_KERNEL;
    // lobes: the scene's surface options where it has lobes to evaluate; wide_queries: of any radius, from maps built by
    // build_dense().
    PhotonGather(Device& device, std::size_t capacity, std::string estimator, int density_kernel, const std::optional<BuildOptions>& lobes = {},
                 bool wide_queries = false)
        : sums(device, capacity, "gathered sums")
    {
        BuildOptions options = lobes.value_or(BuildOptions{});
        options.defines.emplace_back("GATHERS_LOBES", lobes ? "1" : "0");
        options.defines.emplace_back("DENSITY_KERNEL", std::to_string(density_kernel));
        if (wide_queries) options.defines.emplace_back("WIDE_QUERIES", "1");
        options.prelude.push_back(std::move(estimator));
        gather_photons_ = Kernel(device, "gather_photons", "Gather photons", options);
    }

    // lobes: by query, read where a query says so.
    void gather(const PhotonMap& map, const Buffer<GatherQuery>& queries, const Buffer<LobeRecord>& lobes, std::size_t count)
    {
        gather_photons_(count, map, queries, lobes, static_cast<uint>(count), sums);
    }

    Buffer<Result> sums; // by query

private:
    Kernel gather_photons_;
};

} // namespace sundog
