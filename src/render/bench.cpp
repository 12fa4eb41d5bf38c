#include "render/bench.h"

#include "render/bench_photon_map.h"
#include "render/bench_rays.h"
#include "render/bench_renders.h"

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

struct RenderCase {
    std::string method;
    BenchFloor floor;
    std::optional<double> iterations_per_second, percent_without_kernel, megabytes; // targets
};

std::vector<BenchFigure> measure_renders(Device& device)
{
    std::vector<BenchFigure> figures;
    const RenderCase cases[] = {{"sppm", BenchFloor::diffuse, on_cpu(device, 5.0), 5.0, 400.0},
                                {"pppm", BenchFloor::diffuse, {}, {}, {}},
                                {"ptracer", BenchFloor::diffuse, {}, {}, {}},
                                {"path", BenchFloor::diffuse, {}, {}, {}},
                                {"bdpt", BenchFloor::glossy, on_cpu(device, 3.6), {}, {}},
                                {"vcm", BenchFloor::glossy, on_cpu(device, 1.8), {}, {}}};
    // One light subpath a pixel, paths of at most ten edges.
    for (const RenderCase& c : cases) {
        Device own(device.info()); // for a peak of its own
        const RenderFigures f = bench_render(own, cornell_glass_scene(512, 512, c.floor), c.method, 262144, 10, 20);
        const std::string what = fmt::format("{}, cornell-glass{} 512x512", c.method, c.floor == BenchFloor::glossy ? " with a glossy floor" : "");
        figures.push_back({"render", what, "iterations/s", f.iterations_per_second, c.iterations_per_second});
        figures.push_back({"render", what + ", time without a kernel", "%", 100.0 * f.host_share, c.percent_without_kernel, true});
        figures.push_back({"render", what + ", peak device memory", "MB", 1e-6 * f.peak_bytes, c.megabytes, true});
        figures.push_back({"render", what + ", ready after", "s", f.setup_seconds, std::nullopt});
    }
    Device own(device.info());
    const RenderFigures f = bench_render(own, cornell_glass_scene(1920, 1080), "sppm", 2'000'000, 10, 2);
    figures.push_back({"render", "sppm, 1920x1080, 2 million light subpaths", "iterations/s", f.iterations_per_second, std::nullopt});
    figures.push_back({"render", "sppm, 1920x1080, 2 million light subpaths, peak device memory", "MB", 1e-6 * f.peak_bytes, 1500.0, true});
    return figures;
}

std::vector<BenchFigure> measure_kernel_builds(Device& device)
{
    Device own(device.info());
    const RenderFigures f = bench_render(own, cornell_glass_scene(16, 16), "sppm", 256, 10, 1);
    return {{"kernels", "sppm ready, cache as it is", "s", f.kernel_seconds, std::nullopt},
            {"kernels", "first iteration done after", "s", f.setup_seconds, std::nullopt}};
}

} // namespace

const std::vector<BenchSection>& bench_sections()
{
    static const std::vector<BenchSection> sections = {
        {"traversal", "closest and any hit against Embree's single-ray functions", measure_traversal},
        {"photon-map", "building the grid and gathering, against plain C++", measure_photon_map},
        {"render", "whole iterations on the Cornell box with glass", measure_renders},
        {"kernels", "building kernels; set SUNDOG_CACHE_DIR and POCL_CACHE_DIR to empty folders for a cold start", measure_kernel_builds},
    };
    return sections;
}

} // namespace sundog
