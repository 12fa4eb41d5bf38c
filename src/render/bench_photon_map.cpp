#include "render/bench_photon_map.h"

#include "math/vec3.h"
#include "render/bench_timing.h"
#include "stages/photon_gather.h"
#include "stages/photon_map.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <thread>

namespace sundog {

namespace {

constexpr std::size_t photon_count = std::size_t(1) << 20;
constexpr uint query_side = 512;
constexpr std::size_t query_count = std::size_t(query_side) * query_side;
constexpr double photons_per_query = 50.0;
constexpr int rounds = 7;

// work(first, last) for equal parts of [0, n), one a hardware thread.
void in_parallel(std::size_t n, const std::function<void(unsigned part, std::size_t first, std::size_t last)>& work)
{
    const unsigned parts = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::thread> threads;
    for (unsigned part = 0; part < parts; part++) threads.emplace_back([&, part] { work(part, n * part / parts, n * (part + 1) / parts); });
    for (auto& thread : threads) thread.join();
}

// The same grid in plain C++: a counting sort of whole records, and a scalar gather.
class PlainPhotonMap {
public:
    PlainPhotonMap(const std::vector<Photon>& photons, const PhotonGrid& grid)
        : photons_(photons), grid_(grid), cells_(static_cast<std::size_t>(grid.cells_x) * grid.cells_y * grid.cells_z), sorted_(photons.size()),
          counts_(std::max(1u, std::thread::hardware_concurrency()), std::vector<uint>(cells_))
    {
    }

    void build()
    {
        in_parallel(photons_.size(), [&](unsigned part, std::size_t first, std::size_t last) {
            std::vector<uint>& counts = counts_[part];
            std::fill(counts.begin(), counts.end(), 0u);
            for (std::size_t i = first; i < last; i++) counts[cell_of(photons_[i].position)]++;
        });
        uint place = 0;
        for (std::size_t cell = 0; cell < cells_; cell++)
            for (auto& counts : counts_) {
                const uint count = counts[cell];
                counts[cell] = place;
                place += count;
            }
        in_parallel(photons_.size(), [&](unsigned part, std::size_t first, std::size_t last) {
            std::vector<uint>& places = counts_[part];
            for (std::size_t i = first; i < last; i++) sorted_[places[cell_of(photons_[i].position)]++] = photons_[i];
        });
    }

    void gather(const std::vector<GatherQuery>& queries, std::vector<GatherSum>& sums) const
    {
        in_parallel(queries.size(), [&](unsigned, std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; i++) sums[i] = gather(queries[i]);
        });
    }

private:
    uint coordinate(float x, float origin, uint cells) const
    {
        return std::min(static_cast<uint>(std::max((x - origin) * grid_.inverse_cell_size, 0.0f)), cells - 1);
    }

    std::size_t cell_of(Vec3 p) const
    {
        return (static_cast<std::size_t>(coordinate(p.z, grid_.origin.z, grid_.cells_z)) * grid_.cells_y + coordinate(p.y, grid_.origin.y, grid_.cells_y)) *
                   grid_.cells_x +
               coordinate(p.x, grid_.origin.x, grid_.cells_x);
    }

    GatherSum gather(const GatherQuery& query) const
    {
        const float half_cell = 0.5f / grid_.inverse_cell_size;
        const Vec3 shift{half_cell, half_cell, half_cell};
        const Vec3 low = query.position - shift, high = query.position + shift;
        GatherSum sum{};
        const float radius_squared = query.radius * query.radius;
        for (uint z = coordinate(low.z, grid_.origin.z, grid_.cells_z); z <= coordinate(high.z, grid_.origin.z, grid_.cells_z); z++)
            for (uint y = coordinate(low.y, grid_.origin.y, grid_.cells_y); y <= coordinate(high.y, grid_.origin.y, grid_.cells_y); y++) {
                const std::size_t row = (static_cast<std::size_t>(z) * grid_.cells_y + y) * grid_.cells_x;
                const std::size_t first = row + coordinate(low.x, grid_.origin.x, grid_.cells_x), last = row + coordinate(high.x, grid_.origin.x, grid_.cells_x);
                for (uint i = first == 0 ? 0 : counts_.back()[first - 1]; i < counts_.back()[last]; i++) {
                    const Photon& photon = sorted_[i];
                    const Vec3 d = photon.position - query.position;
                    if (dot(d, d) >= radius_squared) continue;
                    sum.flux = sum.flux + photon.flux;
                    sum.count += 1.0f;
                }
            }
        return sum;
    }

    const std::vector<Photon>& photons_;
    PhotonGrid grid_;
    std::size_t cells_;
    std::vector<Photon> sorted_;
    std::vector<std::vector<uint>> counts_; // by thread; after build() the last one's entries are the cells' ends
};

std::vector<Photon> spread_photons()
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<Photon> photons(photon_count);
    // 0x7ff and 0x7ff are the coordinates of +z on the octahedron.
    for (Photon& photon : photons) photon = {{unit(random), unit(random), 0.0f}, 0u, {unit(random), unit(random), unit(random)}, 0x7ffu | (0x7ffu << 12) | (1u << 24)};
    return photons;
}

std::vector<GatherQuery> image_queries(float radius)
{
    std::vector<GatherQuery> queries;
    for (uint y = 0; y < query_side; y++)
        for (uint x = 0; x < query_side; x++)
            queries.push_back({{(static_cast<float>(x) + 0.5f) / query_side, (static_cast<float>(y) + 0.5f) / query_side, 0.0f}, radius, {1, 1, 1}, 100u, {0, 0, 1},
                               static_cast<uint>(queries.size())});
    return queries;
}

double relative_difference(const std::vector<GatherSum>& a, const std::vector<GatherSum>& b)
{
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); i++)
        largest = std::max(largest, static_cast<double>(std::abs(a[i].flux.x - b[i].flux.x)) / std::max(1.0, static_cast<double>(b[i].flux.x)));
    return largest;
}

} // namespace

PhotonMapFigures bench_photon_map(Device& device)
{
    const bool by_cpu = device.info().is_cpu;
    const float radius = static_cast<float>(std::sqrt(photons_per_query / (std::numbers::pi * photon_count)));
    const std::vector<Photon> host_photons = spread_photons();
    RecordList<Photon> photons(device, "benchmark photons", photon_count);
    photons.assign(host_photons);

    PhotonMap map(device, {{0, 0, 0}, {1, 1, 0}});
    map.build(photons, photon_count, radius);
    PlainPhotonMap plain(host_photons, map.grid());
    const PairedTimes build = time_in_turn(
        by_cpu, rounds,
        [&] {
            map.build(photons, photon_count, radius);
            device.finish();
        },
        [&] { plain.build(); });

    const std::vector<GatherQuery> host_queries = image_queries(radius);
    const Buffer<GatherQuery> queries(device, host_queries, "benchmark queries");
    const Buffer<LobeRecord> no_lobes(device, 1, "query lobes");
    PhotonGather<> gather(device, query_count, "estimators/flux_sum.h", 0);
    std::vector<GatherSum> plain_sums(query_count);
    const PairedTimes gathered = time_in_turn(
        by_cpu, rounds,
        [&] {
            gather.gather(map, queries, no_lobes, query_count);
            device.finish();
        },
        [&] { plain.gather(host_queries, plain_sums); });

    const std::vector<GatherSum> sums = gather.sums.download();
    double found = 0.0;
    for (const GatherSum& sum : sums) found += static_cast<double>(sum.count) / query_count;
    return {build.seconds, 1.0 / build.ratio, 1e-6 * query_count / gathered.seconds, gathered.ratio, found, relative_difference(sums, plain_sums)};
}

} // namespace sundog
