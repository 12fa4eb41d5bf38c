// Surfaces of instances: position, normals, tangents, and offsets that rays need to leave them.
#include "kernels/surface_fixture.h"
#include "support/double3.h"
#include "support/instanced_scene.h"
#include "support/scene_builder.h"

#include <random>

namespace sundog
{
namespace
{

class SurfaceInstances : public SurfaceFixture
{
};

TriangleMesh tetrahedron()
{
    return {.positions = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}},
            .normals = {},
            .uvs = {},
            .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
            .attributes = {}};
}

// From around a body that fills about the unit sphere of its own space, in the world.
std::vector<Ray> rays_at(const Transform& to_world)
{
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    std::vector<Ray> rays(20'000);
    for (Ray& ray : rays) {
        const Vec3d direction = normalized(Vec3d(normal(random), normal(random), normal(random)));
        const Vec3d target = Vec3d(normal(random), normal(random), normal(random)) * 0.2;
        const Vec3 origin = to_world.point(to_float(target - direction * 5.0));
        ray = {origin, INFINITY, to_world.point(to_float(target)) - origin, 0};
    }
    return rays;
}

std::vector<Transform> placements()
{
    std::vector<Transform> list = assorted_placements();
    for (double scale : {1e-3, 1e3}) {
        list.push_back(Transform::scale({scale, scale, scale}) * list[3]);
        list.push_back(Transform::translate({300 * scale, -200 * scale, 50 * scale}) * Transform::scale({scale, scale, scale}) * list[3]);
        // A group that is large in its own space, and small in the world, and the other way round.
        list.push_back(Transform::translate({3, -2, 1}) * Transform::scale({scale, scale, scale}) * list[2]);
    }
    return list;
}

// Affine images of convex bodies are convex: rays that leave them miss them, rays that enter meet their other side.
TEST_F(SurfaceInstances, ConvexBodiesAreLeftAndEntered)
{
    for (const bool mesh : {true, false}) {
        for (const Transform& to_world : placements()) {
            SCOPED_TRACE(std::string(mesh ? "tetrahedron " : "sphere ") + std::to_string(to_world.m[0][0]) + " " +
                         std::to_string(to_world.m[0][3]));
            SceneBuilder builder;
            if (mesh)
                builder.shape(tetrahedron());
            else
                builder.shape(Sphere{{0, 0, 0}, 1.0f, false});
            builder.emitter(PointEmitter{{0, 0, 0}, {1, 1, 1}});
            make_instances(builder.scene, 0, {to_world});
            const DeviceScene scene(device_, builder.scene);
            const std::vector<Ray> rays = rays_at(to_world);
            const Surfaces result = follow(scene, rays);
            const Transform to_object = to_world.inverse();
            std::size_t hits = 0, missed_back = 0;
            for (std::size_t i = 0; i < rays.size(); i++) {
                if (result.first[i].primitive == NO_PRIMITIVE) continue;
                hits++;
                ASSERT_EQ(result.first[i].instance, 0u);
                ASSERT_EQ(result.reflected[i].primitive, NO_PRIMITIVE) << "ray " << i << " hits the surface that it leaves";
                if (result.passed[i].primitive == NO_PRIMITIVE)
                    missed_back++; // across an edge, where the way through is shorter than the offset
                else if (mesh) {
                    ASSERT_NE(result.passed[i].primitive, result.first[i].primitive) << "ray " << i << " hits the face it enters by";
                }
                // Back in the group's space the point is on the body, its normal that of the body.
                const Vec3d normal = result.geometric_normals[i], p = to_object.point(result.positions[i]);
                ASSERT_NEAR(length(normal), 1.0, 1e-5);
                ASSERT_LT(dot(normal, Vec3d(rays[i].direction)), 0.0) << "seen from outside";
                const uint face = result.first[i].primitive;
                const Vec3d expected = mesh ? -Vec3d(tetrahedron().positions[std::size_t(3) - face]) / std::sqrt(3.0) : p;
                ASSERT_LT(length(normal - Vec3d(to_world.normal(to_float(expected)))), 2e-3) << "ray " << i;
                ASSERT_LT(length(Vec3d(result.shading_normals[i]) - normal), 1e-5);
                // Positions far from the world's origin are rounded there.
                const double size = length(Vec3d(to_world.vector({1, 1, 1}))), far = length(Vec3d(result.positions[i]));
                const double tolerance = 1e-5 * (1.0 + far / size);
                ASSERT_LT(std::abs(mesh ? dot(expected, p) - 1.0 / std::sqrt(3.0) : length(p) - 1.0), tolerance * 20.0);
                // Tangents lie in the surface.
                for (const Vec3d tangent : {Vec3d(result.dpdu[i]), Vec3d(result.dpdv[i])})
                    ASSERT_LT(std::abs(dot(tangent, normal)), 1e-3 * length(tangent));
            }
            EXPECT_GT(hits, 3000u);
            EXPECT_LT(static_cast<double>(missed_back), 0.01 * static_cast<double>(hits));
        }
    }
}

} // namespace
} // namespace sundog
