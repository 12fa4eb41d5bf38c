#include "render/bench_rays.h"

#include "render/bench_ray_sets.h"
#include "render/bench_timing.h"
#include "stages/geometry_buffers.h"

#include <cmath>
#include <numeric>

namespace sundog
{
namespace
{

// A scene on both sides.
class RayBench
{
public:
    RayBench(Device& device, BenchScene scene, const RayBenchSettings& settings)
        : device_(device), settings_(settings), scene_(std::move(scene)), embree_(scene_.mesh)
    {
        std::vector<Triangle> triangles;
        for (const auto& [a, b, c] : scene_.mesh.triangles) triangles.push_back({{a, b, c}, 0});
        geometry_ = upload_geometry(device, build_bvh({scene_.mesh.positions, triangles, {}}, settings.bvh), {});
        trace_closest_ = Kernel(device, "trace_closest", "Trace closest hits", settings.options);
        trace_any_ = Kernel(device, "trace_any", "Trace shadow rays", settings.options);
    }

    void measure(std::vector<RayFigure>& figures)
    {
        const BenchRays rays = bench_ray_sets(scene_, embree_);
        figures.push_back(measure_closest("camera", rays.camera));
        figures.push_back(measure_closest("bounce", rays.bounce));
        figures.push_back(measure_closest("photon", rays.photon));
        figures.push_back(measure_any("shadow", rays.shadow));
    }

private:
    RayFigure measure_closest(const char* name, const std::vector<Ray>& rays)
    {
        Buffer<Hit> hits(device_, rays.size(), "benchmark hits");
        std::vector<Hit> reference(rays.size());
        RayFigure figure = compare(
            name, rays,
            [&](const auto& ray_buffer, const auto& active, const auto& count) {
                trace_closest_(rays.size(), geometry_, ray_buffer, hits, active, count);
            },
            [&] { embree_.closest(rays, reference); });
        const std::vector<Hit> found = hits.download();
        for (std::size_t i = 0; i < rays.size(); i++) {
            const bool missed = found[i].primitive == NO_PRIMITIVE, reference_missed = reference[i].primitive == NO_PRIMITIVE;
            if (missed != reference_missed || (!missed && !(std::abs(found[i].t - reference[i].t) <= 1e-3f * (reference[i].t + 1e-2f))))
                figure.disagreements++;
        }
        return figure;
    }

    RayFigure measure_any(const char* name, const std::vector<Ray>& rays)
    {
        Buffer<uint> occluded(device_, rays.size(), "benchmark occlusion");
        std::vector<uint> reference(rays.size());
        RayFigure figure = compare(
            name, rays,
            [&](const auto& ray_buffer, const auto& active, const auto& count) {
                trace_any_(rays.size(), geometry_, ray_buffer, active, count, occluded);
            },
            [&] { embree_.any(rays, reference); });
        const std::vector<uint> found = occluded.download();
        for (std::size_t i = 0; i < rays.size(); i++) figure.disagreements += found[i] != reference[i];
        return figure;
    }

    // Interleaves the two sides; each measurement of the device is compared with the mean of its neighbours.
    template <class DeviceSide, class EmbreeSide>
    RayFigure compare(const char* name, const std::vector<Ray>& rays, const DeviceSide& device_side, const EmbreeSide& embree_side)
    {
        Buffer<Ray> ray_buffer(device_, rays, "benchmark rays");
        std::vector<uint> all(rays.size());
        std::iota(all.begin(), all.end(), 0u);
        Buffer<uint> active(device_, all, "benchmark paths");
        Buffer<uint> count(device_, std::vector<uint>{static_cast<uint>(rays.size())}, "benchmark path count");
        const bool by_cpu = device_.info().is_cpu;
        const auto run_device = [&] {
            device_side(ray_buffer, active, count);
            device_.finish();
        };
        const PairedTimes times = time_in_turn(by_cpu, settings_.rounds, run_device, embree_side);
        const double millions = 1e-6 * static_cast<double>(rays.size());
        return {scene_.name, name, scene_.mesh.triangles.size(), millions / times.seconds, millions / times.other_seconds, times.ratio, 0};
    }

    Device& device_;
    const RayBenchSettings& settings_;
    BenchScene scene_;
    EmbreeTracer embree_;
    GeometryBuffers geometry_;
    Kernel trace_closest_, trace_any_;
};

} // namespace

std::vector<RayFigure> bench_rays(Device& device, const RayBenchSettings& settings)
{
    std::vector<RayFigure> figures;
    RayBench(device, small_bench_scene(), settings).measure(figures);
    if (settings.with_large_scene) RayBench(device, large_bench_scene(), settings).measure(figures);
    return figures;
}

} // namespace sundog
