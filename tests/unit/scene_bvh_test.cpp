// The hierarchy of scenes with instances: what each tree holds, boxes, depth.
#include "base/errors.h"
#include "render/bench_meshes.h"
#include "scene/scene_bvh.h"
#include "shared/ray.h"
#include "support/instanced_scene.h"
#include "support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace sundog
{
namespace
{

const PointEmitter lamp{{0, 0, 9}, {1, 1, 1}};

// What one tree holds.
struct Tree {
    std::vector<uint> primitives;
    std::map<uint, Bounds> instances; // and the boxes of their leaves
    std::size_t instance_leaves = 0;
    int depth = 0;

    Tree(const Bvh& bvh, int root) { visit(bvh, root, bvh.bounds, 1); }

    void visit(const Bvh& bvh, int child, const Bounds& box, int level)
    {
        depth = std::max(depth, level);
        if (child >= 0) {
            const BvhNode& node = bvh.nodes.at(static_cast<std::size_t>(child));
            for (int i = 0; i < BVH_WIDTH; i++)
                visit(bvh, node.child[i],
                      {{node.lower_x[i], node.lower_y[i], node.lower_z[i]}, {node.upper_x[i], node.upper_y[i], node.upper_z[i]}},
                      level + 1);
            return;
        }
        const uint code = static_cast<uint>(~child), blocks = (code >> 3 & 7) + (code & 7);
        if (code != 0 && blocks == 0) {
            instance_leaves++;
            instances[(code >> 6) - 1] = box;
        }
        for (uint i = 0; i < blocks; i++)
            for (uint id : bvh.blocks.at((code >> 6) + i).id)
                if (id != NO_PRIMITIVE) primitives.push_back(id);
        std::sort(primitives.begin(), primitives.end());
        primitives.erase(std::unique(primitives.begin(), primitives.end()), primitives.end());
    }
};

TriangleMesh ball(int subdivisions)
{
    TriangleMesh mesh;
    add_icosphere(mesh, {0, 0, 0}, 1.0f, subdivisions);
    return mesh;
}

TEST(SceneBvh, TreesHoldTheirOwnPrimitives)
{
    SceneBuilder builder;
    builder.shape(ball(1)).shape(Sphere{{1, 0, 0}, 0.5f, false});
    make_instances(builder.scene, 0, assorted_placements());
    builder.shape(ball(0));
    make_instances(builder.scene, 2, {Transform::translate({0, 9, 0})});
    builder.shape(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})).shape(Sphere{{5, 5, 5}, 1.0f, false}).emitter(lamp);
    const FlatScene flat = flatten_scene(builder.scene);
    const Bvh bvh = build_scene_bvh(flat);

    const Tree world(bvh, bvh.root);
    EXPECT_EQ(world.primitives, (std::vector<uint>{0, ANALYTIC_BIT}));
    EXPECT_EQ(world.instance_leaves, 8u) << "each once";
    EXPECT_EQ(world.instances.size(), 8u);
    ASSERT_EQ(bvh.instances.size(), 8u);
    std::vector<uint> first(80), second(20);
    for (uint i = 0; i < 80; i++) first[i] = 1 + i;
    for (uint i = 0; i < 20; i++) second[i] = 81 + i;
    first.push_back(ANALYTIC_BIT | 1u);
    for (std::size_t i = 0; i < 8; i++) {
        const Tree group(bvh, bvh.instances[i].root);
        EXPECT_EQ(group.primitives, i < 7 ? first : second) << i;
        EXPECT_EQ(group.instance_leaves, 0u);
    }
    // The boxes hold the copies.
    const TriangleMesh mesh = ball(1);
    for (uint i = 0; i < 7; i++) {
        const Bounds box = world.instances.at(i);
        for (Vec3 p : transformed(mesh, builder.scene.instances[i].to_world.at(0)).positions)
            EXPECT_TRUE(box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y && box.lower.z <= p.z &&
                        p.z <= box.upper.z)
                << i;
    }
}

TEST(SceneBvh, WithoutInstancesOneTree)
{
    SceneBuilder builder;
    builder.shape(ball(2)).emitter(lamp);
    const FlatScene flat = flatten_scene(builder.scene);
    const Bvh one = build_bvh({flat.positions, flat.triangles, flat.analytics}), scene = build_scene_bvh(flat);
    EXPECT_EQ(scene.root, one.root);
    EXPECT_EQ(scene.nodes.size(), one.nodes.size());
    EXPECT_TRUE(scene.instances.empty());
}

// Nothing tells them apart, yet the stack holds what is left of all levels.
TEST(SceneBvh, CoincidingInstancesKeepTheDepth)
{
    SceneBuilder builder;
    builder.shape(ball(0)).emitter(lamp);
    make_instances(builder.scene, 0, std::vector<Transform>(20000));
    const Bvh bvh = build_scene_bvh(flatten_scene(builder.scene));
    const Tree tree(bvh, bvh.root);
    EXPECT_EQ(tree.instances.size(), 20000u);
    EXPECT_LE(tree.depth, BVH_MAX_DEPTH);
    EXPECT_LT(bvh.nodes.size(), 10000u) << "the group's tree is there once";
}

TEST(SceneBvh, RefusesInstancesOutOfRange)
{
    for (double x : {1e13, 1e39}) {
        SceneBuilder builder;
        builder.shape(ball(0)).emitter(lamp);
        make_instances(builder.scene, 0, {Transform::translate({x, 0, 0})});
        EXPECT_THROW(build_scene_bvh(flatten_scene(builder.scene)), SceneError) << x;
    }
}

} // namespace
} // namespace sundog
