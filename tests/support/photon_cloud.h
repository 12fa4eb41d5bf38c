// Photons and queries for tests of the photon map, and what a query must find among all photons.
#pragma once

#include "shared/photon.h"
#include "stages/compaction.h"
#include "stages/photon_gather.h"
#include "stages/photon_map.h"
#include "support/double3.h"

#include <algorithm>
#include <random>

namespace sundog
{

// As pack_normal: two 12-bit octahedral coordinates.
inline uint packed_normal(Vec3d n)
{
    const double scale = 1.0 / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    double x = n.x * scale, y = n.y * scale;
    if (n.z < 0.0) {
        const double folded = (1.0 - std::abs(y)) * std::copysign(1.0, x);
        y = (1.0 - std::abs(x)) * std::copysign(1.0, y);
        x = folded;
    }
    const auto cell = [](double p) { return static_cast<uint>(std::clamp((p + 1.0) * 2048.0, 0.0, 4095.0)); };
    return cell(x) | (cell(y) << 12);
}

// As pack_normal_depth: of deep photons the upper five bits of each coordinate, and 14 bits for the edges.
inline uint packed_normal_depth(Vec3d n, uint depth)
{
    const uint packed = packed_normal(n);
    if (depth < 127) return packed | (depth << 25);
    return std::min(depth - 127, 16383u) | ((packed >> 7) & 31) << 14 | (packed >> 19) << 19 | 127u << 25;
}

inline uint depth_of(const Photon& photon)
{
    const uint field = photon.normal_depth >> 25;
    return field < 127 ? field : 127 + (photon.normal_depth & 16383);
}

inline Vec3d unpacked_normal(uint packed)
{
    double x = ((packed & 0xfff) + 0.5) / 2048.0 - 1.0, y = (((packed >> 12) & 0xfff) + 0.5) / 2048.0 - 1.0;
    if (packed >> 25 == 127) {
        x = (((packed >> 14) & 31) * 128 + 64.5) / 2048.0 - 1.0;
        y = (((packed >> 19) & 31) * 128 + 64.5) / 2048.0 - 1.0;
    }
    const double z = 1.0 - std::abs(x) - std::abs(y), fold = std::max(0.0, -z);
    return normalized(Vec3d(x - std::copysign(fold, x), y - std::copysign(fold, y), z));
}

inline Photon make_test_photon(Vec3 position, Vec3 flux, Vec3d normal = {0, 0, 1}, uint depth = 2)
{
    return {position, 0, flux, packed_normal_depth(normal, depth)};
}

inline GatherQuery make_test_query(Vec3 position, float radius, Vec3 normal = {0, 0, 1}, uint max_depth = UNBOUNDED_DEPTH)
{
    return {position, radius, {1, 1, 1}, max_depth, normal, 0};
}

// Sums over all photons, in double precision. Photons within rounding of the radius or of the largest angle between
// normals may count or not: `least` holds those that must, `most` those that may.
struct BruteForce {
    double least_count = 0, most_count = 0;
    double least_flux = 0, most_flux = 0; // red
};

// margin: relative, of the radius. Normals: cosine above 0.7.
inline BruteForce brute_force(const std::vector<Photon>& photons, const GatherQuery& query, double margin)
{
    BruteForce result;
    for (const Photon& photon : photons) {
        const double t = length(Vec3d(photon.position) - Vec3d(query.position)) / query.radius;
        const double cosine = dot(unpacked_normal(photon.normal_depth), Vec3d(query.normal));
        if (t > 1.0 + margin || cosine < 0.7 - 1e-4 || depth_of(photon) > query.max_photon_depth) continue;
        const bool certain = t < 1.0 - margin && cosine > 0.7 + 1e-4;
        result.most_count += 1.0;
        result.most_flux += photon.flux.x;
        result.least_count += certain ? 1.0 : 0.0;
        result.least_flux += certain ? photon.flux.x : 0.0;
    }
    return result;
}

// A photon map of given photons, and its answers.
class PhotonCloud
{
public:
    PhotonCloud(Device& device, const Bounds& bounds, std::size_t capacity, bool keeps_order = false)
        : device_(&device), compaction_(device, capacity), records_(device, "photons", capacity), map(device, bounds, keeps_order)
    {
    }

    void build(const std::vector<Photon>& photons, float largest_radius) { map.build(records_, record(photons), largest_radius); }

    void build_dense(const std::vector<Photon>& photons, float usual_radius) { map.build_dense(records_, record(photons), usual_radius); }

    template <class Result> std::vector<Result> gather(PhotonGather<Result>& gather, const std::vector<GatherQuery>& queries)
    {
        gather.gather(map, Buffer<GatherQuery>(*device_, queries, "queries"), Buffer<LobeRecord>(*device_, 1, "query lobes"), queries.size());
        return gather.sums.download(0, queries.size());
    }

private:
    std::size_t record(const std::vector<Photon>& photons)
    {
        records_.clear();
        const uint count = static_cast<uint>(photons.size());
        if (count > 0) {
            const Buffer<Photon> deposits(*device_, photons, "deposits");
            const Buffer<uint> flags(*device_, std::vector<uint>(count, PATH_DEPOSIT), "flags"),
                counts(*device_, std::vector{count}, "count");
            records_.append(compaction_, deposits, flags, counts, count);
        }
        return count;
    }

    Device* device_;
    Compaction compaction_;
    RecordList<Photon> records_;

public:
    PhotonMap map;
};

} // namespace sundog
