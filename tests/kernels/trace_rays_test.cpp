// Small scenes against a plain C++ search, and rays that are special: parallel to axes, along faces, null, not numbers.
#include "render/bench_meshes.h"
#include "trace_fixture.h"

namespace sundog
{
namespace
{

// The nearest triangle by Moeller and Trumbore's test in double precision on every triangle.
Hit search(const TriangleMesh& mesh, const Ray& ray, double& clearance)
{
    Hit hit{ray.t_max, 0, 0, NO_PRIMITIVE, NO_INSTANCE};
    clearance = infinite;
    for (uint i = 0; i < mesh.triangles.size(); i++) {
        const auto& [a, b, c] = mesh.triangles[i];
        const Point p(mesh.positions[a]), e = Point(mesh.positions[b]) - p, f = Point(mesh.positions[c]) - p, d(ray.direction);
        const Point across = cross(d, f);
        const double determinant = dot(e, across);
        const Point s = Point(ray.origin) - p, q = cross(s, e);
        const double u = dot(s, across) / determinant, v = dot(d, q) / determinant, t = dot(f, q) / determinant;
        const double nearest_edge = std::min({u, v, 1.0 - u - v});
        if (t > 0.0) clearance = std::min(clearance, std::abs(nearest_edge));
        if (nearest_edge < 0.0 || !(t > 0.0) || !(t < hit.t)) continue;
        hit = {static_cast<float>(t), static_cast<float>(u), static_cast<float>(v), i, NO_INSTANCE};
    }
    return hit;
}

TriangleMesh random_triangles(int count, unsigned seed)
{
    TriangleMesh mesh;
    TestRandom random(seed);
    for (uint i = 0; i < static_cast<uint>(count); i++) {
        for (int k = 0; k < 3; k++) mesh.positions.push_back(random.in_cube(1.0f));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

class TraceRays : public TraceTest
{
};

TEST_F(TraceRays, AgreeWithSearch)
{
    for (int count : {1, 2, 8, 9, 60}) {
        const TriangleMesh mesh = random_triangles(count, 31);
        load(mesh);
        TestRandom random(32);
        std::vector<Ray> rays;
        for (int i = 0; i < 20000; i++) rays.push_back({random.in_cube(1.5f), i % 2 ? infinite : random.uniform(), random.direction(), 0});
        const std::vector<Hit> hits = closest(rays);
        std::size_t doubtful = 0;
        for (std::size_t i = 0; i < rays.size(); i++) {
            double clearance;
            const Hit reference = search(mesh, rays[i], clearance);
            if (clearance < 1e-4) {
                doubtful++;
                continue;
            }
            ASSERT_EQ(hits[i].primitive, reference.primitive) << "ray " << i << " of " << count << " triangles";
            if (reference.primitive == NO_PRIMITIVE) continue;
            EXPECT_NEAR(hits[i].t, reference.t, 1e-4 * reference.t + 1e-6);
            EXPECT_NEAR(hits[i].u, reference.u, 1e-3);
            EXPECT_NEAR(hits[i].v, reference.v, 1e-3);
        }
        EXPECT_LT(doubtful, rays.size() / 20);
    }
}

TEST_F(TraceRays, EmptySceneHitsNothing)
{
    load({});
    const std::vector<Ray> rays{{{0, 0, 0}, infinite, {0, 0, 1}, 0}};
    EXPECT_EQ(closest(rays)[0].primitive, NO_PRIMITIVE);
    EXPECT_EQ(closest(rays)[0].t, infinite);
    EXPECT_EQ(any(rays)[0], 0u);
}

// Along each face of a box in its very plane, and along its edges: the face ahead stops the ray.
TEST_F(TraceRays, AlongFacesOfABox)
{
    TriangleMesh mesh;
    add_box(mesh, {-1, -1, -1}, {1, 1, 1});
    load(mesh);
    std::vector<Ray> rays;
    std::vector<float> expected;
    TestRandom random(33);
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < 4000; i++) {
            // Direction along `axis`; each other coordinate on a face, at a diagonal's height, or anywhere.
            float origin[3], direction[3] = {i % 2 ? 0.0f : -0.0f, 0.0f, -0.0f};
            for (float& x : origin) x = random.between(-0.99f, 0.99f);
            const float sign = i % 4 < 2 ? 1.0f : -1.0f;
            direction[axis] = sign;
            const int other = (axis + 1) % 3, third = (axis + 2) % 3;
            if (i % 3 < 2) origin[other] = i % 5 < 2 ? 1.0f : -1.0f;
            if (i % 3 == 1) origin[third] = i % 7 < 3 ? 1.0f : -1.0f;
            rays.push_back({{origin[0], origin[1], origin[2]}, infinite, {direction[0], direction[1], direction[2]}, 0});
            expected.push_back(1.0f - sign * origin[axis]);
        }
    }
    const std::vector<Hit> hits = closest(rays);
    for (std::size_t i = 0; i < rays.size(); i++) {
        ASSERT_NE(hits[i].primitive, NO_PRIMITIVE) << "ray " << i;
        EXPECT_NEAR(hits[i].t, expected[i], 4e-7f) << "ray " << i;
    }
}

TEST_F(TraceRays, NoRayIsBlockedAndHitsNothing)
{
    TriangleMesh mesh;
    add_box(mesh, {-1, -1, -1}, {1, 1, 1});
    load(mesh);
    const std::vector<Ray> rays{{{0, 0, 0}, 0.0f, {0, 0, 1}, 0}, {{0, 0, 0}, -1.0f, {0, 0, 1}, 0}, {{0, 0, 0}, NAN, {0, 0, 1}, 0}};
    for (uint blocked : any(rays)) EXPECT_EQ(blocked, 1u);
    for (const Hit& hit : closest(rays)) EXPECT_EQ(hit.primitive, NO_PRIMITIVE);
}

TEST_F(TraceRays, NotANumberEndsAndHitsNothing)
{
    TriangleMesh mesh;
    add_icosphere(mesh, {0, 0, 0}, 1.0f, 3);
    load(mesh);
    std::vector<Ray> rays;
    for (float bad : {NAN, infinite, -infinite}) {
        rays.push_back({{bad, 0, 0}, infinite, {0, 0, 1}, 0});
        rays.push_back({{0, bad, 0}, infinite, {0, 1, 0}, 0});
    }
    rays.push_back({{0, 0, 0}, infinite, {0, 0, 0}, 0});
    rays.push_back({{0, 0, 0}, infinite, {NAN, NAN, NAN}, 0});
    for (const Hit& hit : closest(rays)) EXPECT_EQ(hit.primitive, NO_PRIMITIVE);
}

// Only listed paths are traced, and only as many as the count says.
TEST_F(TraceRays, OnlyActivePaths)
{
    TriangleMesh mesh;
    add_box(mesh, {-1, -1, -1}, {1, 1, 1});
    load(mesh);
    const std::vector<Ray> rays(8, Ray{{0, 0, 0}, infinite, {0.1f, 0.2f, 1}, 0});
    Buffer<Ray> ray_buffer(device_, rays, "rays");
    Buffer<Hit> hits(device_, std::vector<Hit>(8, Hit{-1, 0, 0, 77, NO_INSTANCE}), "hits");
    Buffer<uint> occluded(device_, std::vector<uint>(8, 5u), "occlusion");
    Buffer<uint> active(device_, std::vector<uint>{6, 1, 3, 0}, "paths"), count(device_, std::vector<uint>{3}, "path count");
    trace_closest_(8, geometry_, ray_buffer, hits, active, count);
    trace_any_(8, geometry_, ray_buffer, active, count, occluded);
    const std::vector<Hit> found = hits.download();
    const std::vector<uint> blocked = occluded.download();
    for (uint path = 0; path < 8; path++) {
        const bool traced = path == 6 || path == 1 || path == 3;
        EXPECT_EQ(found[path].primitive != 77, traced) << path;
        EXPECT_EQ(blocked[path], traced ? 1u : 5u) << path;
    }
}

// What watertightness rests on: the compiler does not contract edge functions.
TEST_F(TraceRays, EdgeFunctionIsAntisymmetric)
{
    const Kernel kernel = Kernel::from_source(device_, "swap_points", "Swap the points of an edge", R"(
        #include "scene/intersect_triangles.h"
        __kernel void swap_points(__global const float* restrict x, __global float* restrict sums)
        {
            const size_t i = get_global_id(0) * 8;
            const size_t n = get_global_size(0) * 8;
            const float8 x1 = vload8(0, x + i), y1 = vload8(0, x + n + i), x2 = vload8(0, x + 2 * n + i), y2 = vload8(0, x + 3 * n + i);
            vstore8(edge_function(x1, y1, x2, y2) + edge_function(x2, y2, x1, y1), 0, sums + i);
        })");
    const std::size_t items = 4096;
    std::vector<float> x(items * 32);
    TestRandom random(34);
    for (float& value : x) value = random.between(-1.0f, 1.0f);
    Buffer<float> input(device_, x, "points"), sums(device_, items * 8, "sums");
    kernel(items, input, sums);
    for (float sum : sums.download()) ASSERT_EQ(sum, 0.0f);
}

} // namespace
} // namespace sundog
