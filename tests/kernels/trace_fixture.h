// Runs trace_closest and trace_any on a mesh and analytic primitives.
#pragma once

#include "scene/scene.h"
#include "stages/geometry_buffers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace sundog
{

inline constexpr float infinite = std::numeric_limits<float>::infinity();

class TraceTest : public testing::Test
{
protected:
    TraceTest() : device_(select_device("")) {}

    void load(const TriangleMesh& mesh, const std::vector<AnalyticPrimitive>& analytics = {})
    {
        std::vector<Triangle> triangles;
        for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({{a, b, c}, 0});
        geometry_ = upload_geometry(device_, build_bvh({mesh.positions, triangles, analytics}), analytics);
        const BuildOptions options = trace_options(analytics);
        trace_closest_ = Kernel(device_, "trace_closest", "Trace closest hits", options);
        trace_any_ = Kernel(device_, "trace_any", "Trace shadow rays", options);
    }

    std::vector<Hit> closest(const std::vector<Ray>& rays) { return closest(rays, geometry_); }
    std::vector<uint> any(const std::vector<Ray>& rays) { return any(rays, geometry_); }

    std::vector<Hit> closest(const std::vector<Ray>& rays, const GeometryBuffers& geometry)
    {
        Buffer<Ray> ray_buffer(device_, rays, "rays");
        Buffer<Hit> hits(device_, rays.size(), "hits");
        trace_closest_(rays.size(), geometry, ray_buffer, hits, all_paths(rays.size()), path_count_);
        return hits.download();
    }

    std::vector<uint> any(const std::vector<Ray>& rays, const GeometryBuffers& geometry)
    {
        Buffer<Ray> ray_buffer(device_, rays, "rays");
        Buffer<uint> occluded(device_, rays.size(), "occlusion");
        trace_any_(rays.size(), geometry, ray_buffer, all_paths(rays.size()), path_count_, occluded);
        return occluded.download();
    }

    Device device_;
    GeometryBuffers geometry_;
    Kernel trace_closest_, trace_any_;

private:
    const Buffer<uint>& all_paths(std::size_t count)
    {
        if (all_.size() != count) {
            std::vector<uint> paths(count);
            std::iota(paths.begin(), paths.end(), 0u);
            all_ = Buffer<uint>(device_, paths, "paths");
            path_count_ = Buffer<uint>(device_, std::vector<uint>{static_cast<uint>(count)}, "path count");
        }
        return all_;
    }

    Buffer<uint> all_, path_count_;
};

// Fixed-seed random numbers for tests.
class TestRandom
{
public:
    explicit TestRandom(unsigned seed) : engine_(seed) {}
    float uniform() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    float between(float a, float b) { return a + (b - a) * uniform(); }
    std::size_t index(std::size_t count) { return engine_() % count; }
    Vec3 in_cube(float half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    Vec3 direction()
    {
        const float z = between(-1.0f, 1.0f), angle = between(0.0f, 6.2831853f), r = std::sqrt(1.0f - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

private:
    std::mt19937 engine_;
};

// Double-precision vectors for references.
struct Point {
    double x, y, z;
    Point(double px, double py, double pz) : x(px), y(py), z(pz) {}
    Point(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
};
inline Point operator+(Point a, Point b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Point operator-(Point a, Point b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Point operator*(double s, Point a)
{
    return {s * a.x, s * a.y, s * a.z};
}
inline double dot(Point a, Point b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Point cross(Point a, Point b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Point a)
{
    return std::sqrt(dot(a, a));
}

} // namespace sundog
