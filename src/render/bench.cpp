#include "render/bench.h"

#include "render/bench_photon_map.h"
#include "render/bench_rays.h"

#include <fmt/format.h>

namespace sundog {

namespace {

constexpr double small_scene_target = 1.3; // ratio to Embree on ten thousand triangles
constexpr double large_scene_target = 1.0; // on a million

std::vector<BenchFigure> measure_traversal(Device& device)
{
    std::vector<BenchFigure> figures;
    for (const RayFigure& figure : bench_rays(device)) {
        const std::string what = fmt::format("{} rays, {} triangles", figure.rays, figure.triangles);
        const double target = figure.scene == "small" ? small_scene_target : large_scene_target;
        figures.push_back({"traversal", what, "Mrays/s", figure.mrays, std::nullopt});
        figures.push_back({"traversal", what + ", against Embree", "x", figure.ratio, device.info().is_cpu ? std::optional(target) : std::nullopt});
    }
    return figures;
}

// On a device of its own the plain C++ is no measure.
std::optional<double> on_cpu(const Device& device, double target)
{
    return device.info().is_cpu ? std::optional(target) : std::nullopt;
}

std::vector<BenchFigure> measure_photon_map(Device& device)
{
    const PhotonMapFigures f = bench_photon_map(device);
    return {{"photon map", "build of 2^20 photons", "ms", 1e3 * f.build_seconds, std::nullopt},
            {"photon map", "build time, of a plain C++ counting sort's", "x", f.build_time_ratio, on_cpu(device, 1.1), true},
            {"photon map", "queries of " + fmt::format("{:.0f}", f.photons_per_query) + " photons", "M/s", f.million_queries, std::nullopt},
            {"photon map", "queries, against scalar C++", "x", f.gather_ratio, on_cpu(device, 2.0)},
            {"photon map", "largest difference from scalar C++", "", f.largest_difference, 1e-4, true}};
}

} // namespace

const std::vector<BenchSection>& bench_sections()
{
    static const std::vector<BenchSection> sections = {
        {"traversal", "closest and any hit against Embree's single-ray functions", measure_traversal},
        {"photon-map", "building the grid and gathering, against plain C++", measure_photon_map},
    };
    return sections;
}

} // namespace sundog
