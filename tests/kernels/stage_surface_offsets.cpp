// Surfaces at hits, at all scales: the point lies on the surface, and a ray that starts there neither hits the surface
// again nor skips what lies behind it.
#include "kernels/surface_fixture.h"
#include "support/double3.h"
#include "support/scene_builder.h"

#include <random>

namespace sundog
{
namespace
{

class SurfaceOffsets : public SurfaceFixture, public testing::WithParamInterface<double>
{
protected:
    // Rays from around towards points near `center`.
    static std::vector<Ray> rays_at(Vec3d center, double size)
    {
        std::mt19937 random(11);
        std::normal_distribution<double> normal;
        std::vector<Ray> rays(20'000);
        for (Ray& ray : rays) {
            const Vec3d direction = normalized(Vec3d(normal(random), normal(random), normal(random)));
            const Vec3d target = center + Vec3d(normal(random), normal(random), normal(random)) * (0.2 * size);
            ray = {to_float(target - direction * (5.0 * size)), INFINITY, to_float(direction), 0};
        }
        return rays;
    }
};

// A tetrahedron (or a sphere) is convex: rays that leave it miss it, rays that enter meet its other side.
TEST_P(SurfaceOffsets, ConvexBodiesAreLeftAndEntered)
{
    const double scale = GetParam();
    const Vec3d center(3 * scale, -2 * scale, scale);
    const auto vertex = [&](double x, double y, double z) { return to_float(center + Vec3d(x, y, z) * scale); };
    const TriangleMesh tetrahedron{.positions = {vertex(1, 1, 1), vertex(-1, -1, 1), vertex(-1, 1, -1), vertex(1, -1, -1)},
                                   .normals = {},
                                   .uvs = {},
                                   .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
                                   .attributes = {}};
    const Sphere ball{to_float(center), static_cast<float>(scale), false};
    const PointEmitter light{{0, 0, 0}, {1, 1, 1}};
    for (const Scene& host : {SceneBuilder().shape(tetrahedron).emitter(light).scene, SceneBuilder().shape(ball).emitter(light).scene}) {
        const bool mesh = std::holds_alternative<TriangleMesh>(host.shapes[0].geometry);
        SCOPED_TRACE(mesh ? "tetrahedron" : "sphere");
        const DeviceScene scene(device_, host);
        const Surfaces result = follow(scene, rays_at(center, scale));
        std::size_t hits = 0, missed_back = 0;
        for (std::size_t i = 0; i < result.first.size(); ++i) {
            if (result.first[i].primitive == NO_PRIMITIVE) continue;
            ++hits;
            ASSERT_EQ(result.reflected[i].primitive, NO_PRIMITIVE) << "ray " << i << " hits the surface that it leaves";
            // Grazing an edge the way through is shorter than the offset.
            if (result.passed[i].primitive == NO_PRIMITIVE) {
                ++missed_back;
            } else if (mesh) {
                ASSERT_NE(result.passed[i].primitive, result.first[i].primitive) << "ray " << i << " hits the face it enters by";
            }
            const Vec3d normal = result.geometric_normals[i];
            ASSERT_NEAR(length(normal), 1.0, 1e-5);
            ASSERT_GT(dot(normal, Vec3d(result.positions[i]) - center), 0.0) << "the normal points outwards";
            ASSERT_GT(dot(normal, Vec3d(result.outgoing[i])), 0.0) << "seen from outside";
            // Distance from the surface, in ulps of the coordinates.
            const double distance = mesh ? std::abs(dot(normal, Vec3d(result.positions[i]) - center) - scale / std::sqrt(3.0))
                                         : std::abs(length(Vec3d(result.positions[i]) - center) - scale);
            ASSERT_LT(distance, 1e-6 * 4.0 * scale);
        }
        EXPECT_GT(hits, 5000u);
        EXPECT_LT(static_cast<double>(missed_back), 1e-3 * static_cast<double>(hits));
    }
}

// A tube is convex from outside; through its ends one sees it from inside.
TEST_P(SurfaceOffsets, TubesAreLeftFromOutside)
{
    const double scale = GetParam();
    const Vec3d center(3 * scale, -2 * scale, scale);
    const Frame3d frame({0.3, 0.5, 0.8});
    const Cylinder tube{.start = to_float(center - frame.n * scale),
                        .radius = static_cast<float>(scale),
                        .length = static_cast<float>(2 * scale),
                        .axis_x = to_float(frame.s),
                        .axis_y = to_float(frame.t),
                        .axis_z = to_float(frame.n)};
    const DeviceScene scene(device_, SceneBuilder().shape(tube).emitter(PointEmitter{{0, 0, 0}, {1, 1, 1}}).scene);
    const Surfaces result = follow(scene, rays_at(center, scale));
    std::size_t outside = 0, inside = 0;
    for (std::size_t i = 0; i < result.first.size(); ++i) {
        if (result.first[i].primitive == NO_PRIMITIVE) continue;
        const Vec3d normal = result.geometric_normals[i], offset = Vec3d(result.positions[i]) - center;
        const Vec3d radial = offset - frame.n * dot(offset, frame.n);
        ASSERT_LT(std::abs(length(radial) - scale), 1e-6 * 6.0 * scale);
        ASSERT_LT(std::abs(dot(offset, frame.n)), scale * (1 + 1e-5));
        ASSERT_LT(length(normal - normalized(radial)), 1e-5);
        const bool from_outside = dot(normal, Vec3d(result.outgoing[i])) > 0.0;
        ++(from_outside ? outside : inside);
        if (from_outside) {
            ASSERT_EQ(result.reflected[i].primitive, NO_PRIMITIVE) << "ray " << i << " hits the surface that it leaves";
        }
    }
    EXPECT_GT(outside, 5000u);
    EXPECT_GT(inside, 500u);
}

// Two disks close to each other: the first does not shadow itself, nor does the offset jump over the second.
TEST_P(SurfaceOffsets, ThinGapsStayOpen)
{
    const double scale = GetParam();
    const Vec3d center(3 * scale, -2 * scale, scale);
    const auto disk = [&](double height) {
        return Disk{to_float(center + Vec3d(0, 0, height * scale)), {static_cast<float>(scale), 0, 0}, {0, static_cast<float>(scale), 0}};
    };
    const DeviceScene scene(device_, SceneBuilder().shape(disk(0)).shape(disk(-1e-4)).emitter(PointEmitter{{0, 0, 0}, {1, 1, 1}}).scene);
    std::vector<Ray> rays;
    std::mt19937 random(12);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (int i = 0; i < 5000; ++i) {
        const Vec3d target = center + Vec3d(uniform(random), uniform(random), 0) * scale;
        const Vec3d direction = normalized(Vec3d(uniform(random), uniform(random), -0.7));
        rays.push_back({to_float(target - direction * (2.0 * scale)), INFINITY, to_float(direction), 0});
    }
    const Surfaces result = follow(scene, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(result.first[i].primitive, ANALYTIC_BIT | 0u) << i;
        ASSERT_EQ(result.reflected[i].primitive, NO_PRIMITIVE) << i;
        ASSERT_EQ(result.passed[i].primitive, ANALYTIC_BIT | 1u) << i;
    }
}

// Interpolated normals are unit length and lie on the side of the face that the ray came from.
TEST_P(SurfaceOffsets, ShadingNormalsStayOnTheirSide)
{
    const double scale = GetParam();
    TriangleMesh mesh = parallelogram({0, 0, 0}, {static_cast<float>(scale), 0, 0}, {0, static_cast<float>(scale), 0});
    mesh.normals = {to_float(normalized({-1, -1, 0.5})), to_float(normalized({1, -1, 0.5})), to_float(normalized({1, 1, 0.5})),
                    to_float(normalized({-1, 1, 0.5}))};
    const DeviceScene scene(device_, SceneBuilder().shape(mesh).emitter(PointEmitter{{0, 0, 0}, {1, 1, 1}}).scene);
    const Surfaces result = follow(scene, rays_at(Vec3d(0.5, 0.5, 0) * scale, 0.5 * scale));
    int smooth = 0;
    for (std::size_t i = 0; i < result.first.size(); ++i) {
        if (result.first[i].primitive == NO_PRIMITIVE) continue;
        const Vec3d g = result.geometric_normals[i], s = result.shading_normals[i], o = result.outgoing[i];
        ASSERT_NEAR(length(s), 1.0, 1e-5);
        ASSERT_GT(dot(s, o) * dot(g, o), 0.0);
        smooth += length(s - g) > 1e-3 ? 1 : 0;
    }
    EXPECT_GT(smooth, 1000);
}

INSTANTIATE_TEST_SUITE_P(Scales, SurfaceOffsets, testing::Values(1e-3, 1e-1, 1.0, 100.0, 1e4), [](const auto& scale) {
    return "E" + std::to_string(static_cast<int>(std::lround(std::log10(scale.param))) + 3);
});

} // namespace
} // namespace sundog
