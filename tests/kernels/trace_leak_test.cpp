// No ray that starts inside a closed mesh gets out, wherever it is aimed.
#include "render/bench_meshes.h"
#include "trace_fixture.h"

namespace sundog
{
namespace
{

TriangleMesh icosphere()
{
    TriangleMesh mesh;
    add_icosphere(mesh, {0, 0, 0}, 1.0f, 5);
    return mesh;
}

// Star-shaped about the origin with radii from 0.7 to 1.
TriangleMesh bumpy_sphere()
{
    TriangleMesh mesh = icosphere();
    for (Vec3& p : mesh.positions) p = p * (0.7f + 0.3f * value_noise(40.0f * p.x + 9.0f * p.z, 40.0f * p.y - 7.0f * p.z));
    return mesh;
}

TriangleMesh box()
{
    TriangleMesh mesh;
    add_box(mesh, {-1, -1, -1}, {1, 1, 1});
    return mesh;
}

struct Placement {
    const char* shape;
    float scale;
    Vec3 offset;
};

class TraceLeak : public TraceTest, public testing::WithParamInterface<Placement>
{
};

TriangleMesh place(const Placement& placement)
{
    const std::string shape = placement.shape;
    TriangleMesh mesh = shape == "icosphere" ? icosphere() : shape == "bumpy" ? bumpy_sphere() : box();
    for (Vec3& p : mesh.positions) p = placement.scale * p + placement.offset;
    return mesh;
}

// From a point inside, a third each to a vertex, to a point of an edge, and anywhere.
Ray make_ray(const TriangleMesh& mesh, const Placement& placement, std::size_t i, TestRandom& random)
{
    const Vec3 origin = placement.scale * random.in_cube(0.35f) + placement.offset;
    const auto& triangle = mesh.triangles[random.index(mesh.triangles.size())];
    const Vec3 a = mesh.positions[triangle[0]], b = mesh.positions[triangle[1]];
    const float s = i % 3 == 0 ? 0.0f : random.uniform();
    const Vec3 direction = i % 3 == 2 ? random.direction() : a + s * (b - a) - origin;
    return {origin, infinite, direction, 0};
}

TEST_P(TraceLeak, NoRayGetsOut)
{
    const Placement placement = GetParam();
    const TriangleMesh mesh = place(placement);
    load(mesh);
    TestRandom random(11);
    constexpr std::size_t batch = 1 << 18;
    std::size_t escaped = 0, unblocked = 0;
    for (std::size_t done = 0; done < (std::size_t(1) << 20); done += batch) { // ten placements make 10^7 rays
        std::vector<Ray> rays;
        for (std::size_t i = 0; i < batch; i++) rays.push_back(make_ray(mesh, placement, i, random));
        for (const Hit& hit : closest(rays)) escaped += hit.primitive == NO_PRIMITIVE;
        if (done == 0)
            for (uint blocked : any(rays)) unblocked += blocked == 0;
    }
    EXPECT_EQ(escaped, 0u);
    EXPECT_EQ(unblocked, 0u);
}

// At 1000 from the origin of coordinates, coordinates are spaced 6e-5 apart; the sphere's edges are 0.02 long.
INSTANTIATE_TEST_SUITE_P(Placements, TraceLeak,
                         testing::Values(Placement{"icosphere", 1.0f, {0, 0, 0}}, Placement{"icosphere", 1e-3f, {0, 0, 0}},
                                         Placement{"icosphere", 1e4f, {0, 0, 0}}, Placement{"icosphere", 1.0f, {1000, -2000, 500}},
                                         Placement{"bumpy", 1.0f, {0, 0, 0}}, Placement{"bumpy", 1e-3f, {0, 0, 0}},
                                         Placement{"bumpy", 1e4f, {0, 0, 0}}, Placement{"bumpy", 1e4f, {3e5f, 1e5f, -2e5f}},
                                         Placement{"box", 1.0f, {0, 0, 0}}, Placement{"box", 1e-3f, {0.1f, 0.2f, 0.3f}}));

} // namespace
} // namespace sundog
