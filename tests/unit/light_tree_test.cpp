// The tree of lights as it is built: every light once, within its ancestors' bounds.
#include "scene/light_tree.h"
#include "support/many_lights.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>

namespace sundog
{
namespace
{

double angle_between(Vec3d a, Vec3d b)
{
    return std::atan2(length(cross(a, b)), dot(a, b));
}

// Points of a light that are as far out as any.
std::vector<Vec3d> extremes(const FlatScene& flat, const Light& light)
{
    if (light.type == LIGHT_TRIANGLE) {
        const Triangle& triangle = flat.triangles[light.primitive];
        return {flat.positions[triangle.vertex[0]], flat.positions[triangle.vertex[1]], flat.positions[triangle.vertex[2]]};
    }
    if (light.type != LIGHT_SPHERE && light.type != LIGHT_DISK && light.type != LIGHT_CYLINDER) return {light.position};
    const AnalyticPrimitive& primitive = flat.analytics[light.primitive & ~ANALYTIC_BIT];
    std::vector<Vec3d> points;
    for (int i = 0; i < 64; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 64;
        const Vec3d around = Vec3d(primitive.axis_u) * std::cos(angle) + Vec3d(primitive.axis_v) * std::sin(angle);
        const Vec3d rim = Vec3d(primitive.center) + around * (light.type == LIGHT_DISK ? 1.0 : static_cast<double>(primitive.radius));
        points.push_back(rim);
        if (light.type == LIGHT_CYLINDER) points.push_back(rim + Vec3d(primitive.normal) * static_cast<double>(primitive.length));
    }
    return points;
}

// What a light is lies within the node's sphere, and its cone within the node's.
void expect_contains(const LightNode& node, const LightNode& light, const std::vector<Vec3d>& points)
{
    for (const Vec3d& point : points) EXPECT_LE(length(point - Vec3d(node.center)), node.radius * (1.0 + 1e-6) + 1e-6);
    if (node.cos_spread > -1.0f) {
        const double spread = std::acos(std::min(1.0, static_cast<double>(node.cos_spread)));
        EXPECT_LE(angle_between(light.axis, node.axis) + std::acos(std::min(1.0, static_cast<double>(light.cos_spread))), spread + 5e-4);
        EXPECT_NEAR(node.sin_spread, std::sin(spread), 5e-4);
    }
    EXPECT_LE(node.cos_reach, light.cos_reach);
    EXPECT_GE(node.cos_reach, -1e-6f);
}

// Visits each light below a node with the number of levels between.
void visit(const std::vector<LightNode>& nodes, uint lights, uint node, int level, const std::function<void(uint, int)>& each)
{
    if (node < lights) return each(node, level);
    for (const uint child : {nodes[node].first, nodes[node].second}) {
        ASSERT_LT(child, nodes.size());
        ASSERT_EQ(nodes[child].parent, node);
        visit(nodes, lights, child, level + 1, each);
    }
}

TEST(LightTreeBuild, HoldsEveryLightOnceWithinItsBounds)
{
    const FlatScene flat = flatten_scene(many_lights(700, 2, true));
    const std::vector<LightNode> nodes = build_light_tree(flat);
    const uint lights = flat.globals.light_count;
    ASSERT_EQ(nodes.size(), 2 * lights - 1);
    EXPECT_EQ(nodes[lights].parent, NO_NODE);
    std::vector<int> seen(lights, 0);
    visit(nodes, lights, lights, 0, [&](uint light, int) { seen[light]++; });
    for (const int times : seen) EXPECT_EQ(times, 1);
    for (uint node = lights; node < nodes.size(); ++node) {
        if (nodes[node].first_share >= 0.0f) continue;
        double intensity = 0.0;
        visit(nodes, lights, node, 0, [&](uint light, int) {
            intensity += static_cast<double>(nodes[light].intensity);
            expect_contains(nodes[node], nodes[light], extremes(flat, flat.lights[light]));
        });
        EXPECT_NEAR(nodes[node].intensity, intensity, 1e-5 * intensity);
    }
}

TEST(LightTreeBuild, IsAFunctionOfTheScene)
{
    const FlatScene flat = flatten_scene(many_lights(300, 2, true));
    const auto a = build_light_tree(flat), b = build_light_tree(flat);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(LightNode)), 0);
}

// The sun, a sky and two lamps: three choices, of which each has a sixth for its own.
TEST(LightTreeBuild, LightsFromEverywhereHaveTheirShares)
{
    SceneBuilder builder;
    builder.shape(Sphere{{0, 0, 0}, 10.0f}).emitter(PointEmitter{{1, 0, 0}, {1, 1, 1}}).emitter(PointEmitter{{-1, 0, 0}, {1, 1, 1}});
    builder.emitter(DirectionalEmitter{{0, 0, 1}, {1e6f, 1e6f, 1e6f}}).emitter(ConstantEmitter{{1e-3f, 1e-3f, 1e-3f}});
    const FlatScene flat = flatten_scene(builder.scene);
    const auto nodes = build_light_tree(flat);
    ASSERT_EQ(nodes.size(), 7u);
    EXPECT_EQ(nodes[4].first, 2u);
    const double sun = nodes[4].first_share, sky = (1.0 - sun) * nodes[5].first_share, lamps = (1.0 - sun) * (1.0 - nodes[5].first_share);
    EXPECT_EQ(nodes[5].first, 3u);
    EXPECT_NEAR(sun, 0.5 / 3 + 0.5 * flat.lights[2].probability, 1e-5);
    EXPECT_NEAR(sky, 0.5 / 3 + 0.5 * flat.lights[3].probability, 1e-5);
    EXPECT_GT(lamps, 0.5 / 3);
    EXPECT_LT(nodes[6].first_share, 0.0f);
}

TEST(LightTreeBuild, LeavesOutWhatHasNoPower)
{
    SceneBuilder builder;
    builder.shape(Sphere{{0, 0, 0}, 10.0f});
    for (int i = 0; i < 9; ++i) builder.emitter(PointEmitter{{static_cast<float>(i), 0, 0}, i % 3 == 0 ? Vec3{0, 0, 0} : Vec3{1, 1, 1}});
    const auto nodes = build_light_tree(flatten_scene(builder.scene));
    std::vector<int> seen(9, 0);
    visit(nodes, 9, 9, 0, [&](uint light, int) { seen[light]++; });
    for (int i = 0; i < 9; ++i) {
        EXPECT_EQ(seen[static_cast<std::size_t>(i)], i % 3 == 0 ? 0 : 1);
        if (i % 3 == 0) {
            EXPECT_EQ(nodes[static_cast<std::size_t>(i)].parent, NO_NODE);
        }
    }
    EXPECT_TRUE(build_light_tree(flatten_scene(SceneBuilder().shape(Sphere{}).emitter(PointEmitter{{0, 0, 0}, {1, 1, 1}}).scene)).empty());
}

// Lights at 2^i, which binning separates one by one; all in one place, which it cannot separate.
TEST(LightTreeBuild, StaysShallow)
{
    SceneBuilder spread, heap;
    spread.shape(Sphere{});
    heap.shape(Sphere{});
    for (int i = 0; i < 120; ++i) spread.emitter(PointEmitter{{std::ldexp(1.0f, i - 60), 0, 0}, {1, 1, 1}});
    for (int i = 0; i < 5000; ++i) heap.emitter(PointEmitter{{1, 2, 3}, {1, 1, 1}});
    for (const Scene* scene : {&spread.scene, &heap.scene}) {
        const FlatScene flat = flatten_scene(*scene);
        const auto nodes = build_light_tree(flat);
        visit(nodes, flat.globals.light_count, flat.globals.light_count, 0, [](uint, int level) { ASSERT_LT(level, 60); });
    }
}

} // namespace
} // namespace sundog
