// Rays through moving instances, at times across the shutter, against Embree on copies placed where they are then.
#include "render/bench_meshes.h"
#include "render/bench_ray_sets.h"
#include "stages/device_scene.h"
#include "support/instanced_scene.h"
#include "support/scene_builder.h"
#include "trace_fixture.h"

namespace sundog
{
namespace
{

constexpr Shutter shutter{1.0, 3.0};

Transform key(Double3 to, Double3 axis, double degrees, Double3 scale = {1, 1, 1})
{
    return Transform::translate(to) * Transform::rotate(axis, degrees) * Transform::scale(scale);
}

// Slides; turns far about a distant point; grows and tumbles through three keys, mirrored; and stands still.
std::vector<AnimatedTransform> motions()
{
    using Keys = std::vector<TransformKey>;
    const Transform arm = Transform::translate({2.5, 0, 0});
    return {AnimatedTransform(Keys{{0, key({-3, -3, -3}, {0, 0, 1}, 0)}, {3, key({3, -3, -3}, {0, 0, 1}, 0)}}),
            AnimatedTransform(Keys{{1, arm}, {3, Transform::rotate({0.3, 1, 0.1}, 175) * arm}}),
            AnimatedTransform(Keys{{0, key({0, 3, 0}, {1, 0, 0}, 10, {-0.3, 0.5, 0.3})},
                                   {2, key({0, 3, 2}, {1, 1, 0}, 120, {-1, 0.5, 0.5})},
                                   {4, key({-1, 2.5, -2}, {0, 1, 3}, 200, {-0.6, 0.6, 0.6})}}),
            AnimatedTransform(key({0, -3, 3}, {0, 1, 0}, 30))};
}

class TraceMotion : public TraceTest
{
};

TEST_F(TraceMotion, HitsAreThoseOfCopiesAtThatTime)
{
    TriangleMesh walls, ball;
    add_box(walls, {-4, -4, -4}, {4, 4, 4});
    add_icosphere(ball, {0, 0, 0}, 1.0f, 2);
    for (Vec3& p : ball.positions) p = p * Vec3{1.0f, 0.4f, 0.7f};
    SceneBuilder builder;
    builder.shape(ball).emitter(PointEmitter{{0, 0, 0}, {1, 1, 1}});
    make_instances(builder.scene, 0, std::vector<Transform>(motions().size()));
    for (std::size_t i = 0; i < motions().size(); i++) builder.scene.instances[i].to_world = motions()[i];
    builder.shape(walls);
    builder.scene.sensor.shutter = shutter;
    DeviceScene scene(device_, builder.scene);
    trace_closest_ = Kernel(device_, "trace_closest", "Trace closest hits", scene.trace_options());
    trace_any_ = Kernel(device_, "trace_any", "Trace shadow rays", scene.trace_options());

    TestRandom random(44);
    std::vector<std::size_t> found(motions().size());
    for (double time : {1.0, 1.2, 1.7, 2.0, 2.4, 3.0, 1.0}) {
        SCOPED_TRACE(time);
        scene.set_time(time);
        TriangleMesh copies = walls;
        std::vector<std::pair<uint, uint>> origins;
        for (uint i = 0; i < walls.triangles.size(); i++) origins.emplace_back(NO_INSTANCE, i);
        for (uint i = 0; i < motions().size(); i++) {
            const TriangleMesh copy = transformed(ball, motions()[i].at(time));
            const uint base = static_cast<uint>(copies.positions.size());
            copies.positions.insert(copies.positions.end(), copy.positions.begin(), copy.positions.end());
            for (uint t = 0; t < copy.triangles.size(); t++) {
                const auto& [a, b, c] = copy.triangles[t];
                copies.triangles.push_back({base + a, base + b, base + c});
                origins.emplace_back(i, static_cast<uint>(walls.triangles.size()) + t);
            }
        }
        std::vector<Ray> rays;
        for (int i = 0; i < 40000; i++) {
            const Vec3 origin = random.in_cube(3.9f),
                       place = motions()[random.index(motions().size())].at(time).point(random.in_cube(0.6f));
            rays.push_back({origin, i % 4 ? infinite : random.between(0.0f, 3.0f), i % 2 ? place - origin : random.direction(), 0});
        }
        const std::vector<Hit> hits = closest(rays, scene.geometry());
        const std::vector<uint> blocked = any(rays, scene.geometry());
        std::vector<Hit> reference(rays.size());
        EmbreeTracer(copies, RTC_SCENE_FLAG_ROBUST).closest(rays, reference);
        std::size_t different = 0;
        for (std::size_t i = 0; i < rays.size(); i++) {
            EXPECT_EQ(blocked[i] == 1, hits[i].primitive != NO_PRIMITIVE) << "ray " << i;
            const bool theirs = reference[i].primitive != NO_PRIMITIVE;
            const auto expected = theirs ? origins[reference[i].primitive] : std::pair(NO_INSTANCE, NO_PRIMITIVE);
            if (std::pair(hits[i].primitive == NO_PRIMITIVE ? NO_INSTANCE : hits[i].instance, hits[i].primitive) != expected) {
                different++;
                continue;
            }
            if (theirs && expected.first != NO_INSTANCE) {
                found[expected.first]++;
                EXPECT_NEAR(hits[i].t, reference[i].t, 1e-3f) << "ray " << i;
            }
        }
        // Rounding displaces a ray by up to d = 7e-6 (as in trace_instances_test.cpp). A ball of 320 triangles of perimeter
        // 0.5 shows edges of length 40 on an area of 2: 2 d * 40 / 2 = 3e-4 of the rays may pass an edge on the other side.
        EXPECT_LT(static_cast<double>(different), 3e-4 * static_cast<double>(rays.size()));
    }
    for (std::size_t i = 0; i < found.size(); i++) EXPECT_GT(found[i], 3000u) << "of instance " << i;
}

} // namespace
} // namespace sundog
