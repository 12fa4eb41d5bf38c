// The hierarchy's invariants, and what the builder refuses.
#include "base/errors.h"
#include "render/bench_meshes.h"
#include "scene/bvh_build.h"
#include "scene/bvh_primitives.h"
#include "shared/ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <set>
#include <stdexcept>

namespace sundog
{
namespace
{

std::vector<Triangle> triangles_of(const TriangleMesh& mesh)
{
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({{a, b, c}, 0});
    return triangles;
}

Bvh build(const TriangleMesh& mesh, const std::vector<AnalyticPrimitive>& analytics = {})
{
    return build_bvh({mesh.positions, triangles_of(mesh), analytics});
}

AnalyticPrimitive make_sphere(Vec3 center, float radius)
{
    AnalyticPrimitive sphere{};
    sphere.center = center;
    sphere.radius = radius;
    sphere.kind = ANALYTIC_SPHERE;
    return sphere;
}

// Needles of all directions, up to 1000 times as long as wide, which spatial splits cut many times.
TriangleMesh needles(uint count, unsigned seed)
{
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    TriangleMesh mesh;
    for (uint i = 0; i < count; i++) {
        const Vec3 a{uniform(engine), uniform(engine), uniform(engine)}, b{uniform(engine), uniform(engine), uniform(engine)};
        mesh.positions.insert(mesh.positions.end(), {a, b, a + 1e-3f * Vec3{uniform(engine), uniform(engine), uniform(engine)}});
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

bool contains(const Bounds& box, Vec3 p)
{
    return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y && box.lower.z <= p.z && p.z <= box.upper.z;
}

// Everything about a tree that a walk through it can see.
struct Walk {
    const Bvh& bvh;
    std::set<uint> ids;
    int depth = 0;
    std::size_t nodes = 0, blocks = 0;
    std::vector<std::vector<Bounds>> boxes; // of the leaves that hold each triangle

    explicit Walk(const Bvh& tree, std::size_t triangle_count) : bvh(tree), boxes(triangle_count) { visit(tree.root, {}, 1); }

    void visit(int child, const Bounds& box, int level)
    {
        depth = std::max(depth, level);
        if (child < 0) return visit_leaf(static_cast<uint>(~child), box);
        ASSERT_LT(static_cast<std::size_t>(child), bvh.nodes.size());
        nodes++;
        const BvhNode& node = bvh.nodes[static_cast<std::size_t>(child)];
        for (int i = 0; i < BVH_WIDTH; i++)
            visit(node.child[i], {{node.lower_x[i], node.lower_y[i], node.lower_z[i]}, {node.upper_x[i], node.upper_y[i], node.upper_z[i]}},
                  level + 1);
    }

    void visit_leaf(uint code, const Bounds& box)
    {
        const uint first = code >> 6, triangle_blocks = code >> 3 & 7, analytic_blocks = code & 7;
        ASSERT_LE(first + triangle_blocks + analytic_blocks, bvh.blocks.size());
        blocks += triangle_blocks + analytic_blocks;
        for (uint i = 0; i < triangle_blocks + analytic_blocks; i++) {
            uint previous = 0;
            for (uint id : bvh.blocks[first + i].id) {
                EXPECT_GE(id, previous); // ascending
                previous = id;
                if (id == NO_PRIMITIVE) continue;
                EXPECT_EQ((id & ANALYTIC_BIT) != 0, i >= triangle_blocks);
                ids.insert(id);
                if (!(id & ANALYTIC_BIT)) boxes[id].push_back(box);
            }
        }
    }
};

TEST(BvhBuild, NothingMakesAnEmptyLeaf)
{
    const Bvh bvh = build({});
    EXPECT_EQ(bvh.root, ~0);
    EXPECT_TRUE(bvh.nodes.empty());
    EXPECT_TRUE(bvh.blocks.empty());
    EXPECT_TRUE(bvh.bounds.empty());
}

TEST(BvhBuild, OnePrimitiveIsALeaf)
{
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    mesh.triangles = {{0, 1, 2}};
    const Bvh triangle = build(mesh);
    EXPECT_EQ(Walk(triangle, 1).ids, std::set<uint>{0});
    EXPECT_EQ(triangle.bounds.upper.y, 2.0f);

    const Bvh sphere = build({}, {make_sphere({1, 2, 3}, 0.5f)});
    EXPECT_EQ(Walk(sphere, 0).ids, std::set<uint>{ANALYTIC_BIT});
    EXPECT_LE(sphere.bounds.lower.x, 0.5f);
    EXPECT_NEAR(sphere.bounds.lower.x, 0.5f, 1e-5f);
}

TEST(BvhBuild, IdenticalPrimitives)
{
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles.assign(5000, {0, 1, 2});
    const Bvh bvh = build(mesh, std::vector<AnalyticPrimitive>(300, make_sphere({0, 0, 0}, 1.0f)));
    const Walk walk(bvh, 5000);
    EXPECT_EQ(walk.ids.size(), 5300u);
    EXPECT_LE(walk.depth, BVH_MAX_DEPTH);
}

TEST(BvhBuild, DepthIsBounded)
{
    // Each triangle half as large and half as far as the one before: nothing balances that.
    TriangleMesh mesh;
    float x = 1e6f;
    for (uint i = 0; i < 300; i++, x *= 0.75f) {
        mesh.positions.insert(mesh.positions.end(), {{x, 0, 0}, {0.8f * x, 0.1f * x, 0}, {0.8f * x, 0, 0.1f * x}});
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Bvh bvh = build(mesh);
    EXPECT_LE(Walk(bvh, 300).depth, BVH_MAX_DEPTH);
}

// Every point of every triangle lies in a leaf that holds it: also where spatial splits cut.
TEST(BvhBuild, LeavesCoverTheirTriangles)
{
    for (const TriangleMesh& mesh : {needles(3000, 1), [] {
                                         TriangleMesh sphere;
                                         add_icosphere(sphere, {5, 5, 5}, 1.0f, 4);
                                         return sphere;
                                     }()}) {
        const Bvh bvh = build(mesh);
        const Walk walk(bvh, mesh.triangles.size());
        EXPECT_EQ(walk.ids.size(), mesh.triangles.size());
        EXPECT_EQ(walk.nodes, bvh.nodes.size());
        EXPECT_EQ(walk.blocks, bvh.blocks.size());
        std::size_t lost = 0;
        for (std::size_t i = 0; i < mesh.triangles.size(); i++) {
            const auto& [a, b, c] = mesh.triangles[i];
            for (int s = 0; s <= 16; s++) {
                for (int t = 0; s + t <= 16; t++) {
                    const float u = static_cast<float>(s) / 16.0f, v = static_cast<float>(t) / 16.0f;
                    const Vec3 p = mesh.positions[a] * (1.0f - u - v) + mesh.positions[b] * u + mesh.positions[c] * v;
                    bool found = false;
                    for (Bounds box : walk.boxes[i]) {
                        // The point itself is rounded, by an ulp of the coordinates.
                        const float ulp = 1e-6f;
                        found |= contains({box.lower - Vec3{ulp, ulp, ulp}, box.upper + Vec3{ulp, ulp, ulp}}, p);
                    }
                    lost += !found;
                }
            }
        }
        EXPECT_EQ(lost, 0u);
    }
}

TEST(BvhBuild, SplitPartsHoldTheTriangle)
{
    const std::vector<Vec3> positions{{0, 0, 0}, {4, 0, 0}, {0, 8, 2}};
    const std::vector<Triangle> triangles{{{0, 1, 2}, 0}};
    const SplitBounds parts = split_bounds({positions, triangles, {}}, 0, {{0, 0, 0}, {4, 8, 2}}, 0, 1.0f);
    // At x = 1 the edges are at y = 0 and y = 6, z = 1.5.
    EXPECT_EQ(parts.below.upper.x, 1.0f);
    EXPECT_EQ(parts.below.upper.y, 8.0f);
    EXPECT_EQ(parts.above.lower.x, 1.0f);
    EXPECT_GE(parts.above.upper.y, 6.0f);
    EXPECT_NEAR(parts.above.upper.y, 6.0f, 1e-5f);
    EXPECT_GE(parts.above.upper.z, 1.5f);
    EXPECT_NEAR(parts.above.upper.z, 1.5f, 1e-5f);
    EXPECT_EQ(parts.above.upper.x, 4.0f);
}

TEST(BvhBuild, SpatialSplitsCutNeedles)
{
    const TriangleMesh mesh = needles(2000, 2);
    const std::vector<Triangle> triangles = triangles_of(mesh);
    const auto area = [](const Bvh& bvh) {
        double sum = 0.0;
        for (const BvhNode& node : bvh.nodes) {
            for (int i = 0; i < BVH_WIDTH; i++) {
                const double x = node.upper_x[i] - node.lower_x[i], y = node.upper_y[i] - node.lower_y[i],
                             z = node.upper_z[i] - node.lower_z[i];
                sum += x * y + y * z + z * x;
            }
        }
        return sum;
    };
    // Small leaves: in larger ones the builder may stop before it would split.
    BvhSettings with;
    with.min_leaf_size = 1;
    with.max_leaf_size = BVH_WIDTH;
    with.intersection_cost = 1.0f;
    BvhSettings without = with;
    without.extra_references = 0.0f;
    EXPECT_LT(area(build_bvh({mesh.positions, triangles, {}}, with)), 0.9 * area(build_bvh({mesh.positions, triangles, {}}, without)));
}

TEST(BvhBuild, TrianglesWithoutAreaAreLeftOut)
{
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
    mesh.triangles = {{0, 0, 0}, {0, 1, 0}, {0, 1, 3}, {0, 1, 2}};
    const Bvh bvh = build(mesh);
    EXPECT_EQ(Walk(bvh, 4).ids, std::set<uint>{3});
}

bool equal_bits(const Bvh& a, const Bvh& b)
{
    return a.root == b.root && a.nodes.size() == b.nodes.size() && a.blocks.size() == b.blocks.size() &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0 &&
           std::memcmp(a.blocks.data(), b.blocks.data(), a.blocks.size() * sizeof(BvhBlock)) == 0;
}

// Large enough for Embree to build in parallel, with enough splits to compete for the room for them.
TEST(BvhBuild, SameBitsEveryTime)
{
    TriangleMesh mesh = needles(3000, 4);
    add_terrain(mesh, 150, 1.0f, [](float x, float z) { return 0.3f * fractal_noise(4.0f * x, 4.0f * z, 5); });
    const Bvh first = build(mesh);
    for (int i = 0; i < 4; i++) EXPECT_TRUE(equal_bits(first, build(mesh)));
}

TEST(BvhBuild, RefusesWhatItCannotBuild)
{
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 3}};
    EXPECT_THROW(build(mesh), std::logic_error);
    mesh.triangles = {{0, 1, 2}};
    for (float bad : {NAN, INFINITY, -INFINITY, 1e13f}) {
        mesh.positions[2].y = bad;
        EXPECT_THROW(build(mesh), SceneError);
    }
    EXPECT_THROW(build({}, {make_sphere({0, 0, 0}, INFINITY)}), SceneError);
    EXPECT_THROW(build({}, {make_sphere({NAN, 0, 0}, 1.0f)}), SceneError);
}

} // namespace
} // namespace sundog
