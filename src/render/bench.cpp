#include "render/bench.h"

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

} // namespace

const std::vector<BenchSection>& bench_sections()
{
    static const std::vector<BenchSection> sections = {
        {"traversal", "closest and any hit against Embree's single-ray functions", measure_traversal},
    };
    return sections;
}

} // namespace sundog
