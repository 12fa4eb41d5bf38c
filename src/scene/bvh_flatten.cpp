#include "scene/bvh_flatten.h"

#include "base/errors.h"
#include "shared/ray.h"

#include <algorithm>
#include <cassert>

namespace sundog
{
namespace
{

constexpr int empty_leaf = ~0;
// Outside of every scene (build_bvh refuses coordinates beyond 1e12).
constexpr float nowhere = 1e30f;
constexpr std::size_t largest_block_count = std::size_t(1) << (31 - 2 * BVH_LEAF_BLOCK_BITS);

static_assert((BuildLeaf::capacity + BVH_WIDTH - 1) / BVH_WIDTH <= BVH_LEAF_MAX_BLOCKS);

BvhNode empty_node()
{
    BvhNode node{};
    for (int i = 0; i < BVH_WIDTH; i++) {
        node.lower_x[i] = node.upper_x[i] = node.lower_y[i] = node.upper_y[i] = node.lower_z[i] = node.upper_z[i] = nowhere;
        node.child[i] = empty_leaf;
    }
    return node;
}

void set_child(BvhNode& node, int i, const Bounds& bounds, int child)
{
    node.lower_x[i] = bounds.lower.x, node.upper_x[i] = bounds.upper.x;
    node.lower_y[i] = bounds.lower.y, node.upper_y[i] = bounds.upper.y;
    node.lower_z[i] = bounds.lower.z, node.upper_z[i] = bounds.upper.z;
    node.child[i] = child;
}

// add_leaf: from a leaf to its code as BvhNode::child.
template <class AddLeaf> int add_tree(const BuildNode& node, Bvh& bvh, AddLeaf& add_leaf)
{
    if (node.is_leaf) return add_leaf(static_cast<const BuildLeaf&>(node));
    const auto& inner = static_cast<const BuildInner&>(node);
    const std::size_t index = bvh.nodes.size();
    bvh.nodes.emplace_back();
    BvhNode flat = empty_node();
    for (int i = 0; i < inner.count; i++) set_child(flat, i, inner.bounds[i], add_tree(*inner.children[i], bvh, add_leaf));
    bvh.nodes[index] = flat;
    return static_cast<int>(index);
}

class LeafFlattener
{
public:
    LeafFlattener(const BvhGeometry& geometry, Bvh& bvh) : geometry_(geometry), bvh_(bvh) {}

    int operator()(const BuildLeaf& leaf)
    {
        // Triangles come before analytic primitives, whose ids are larger.
        const uint* end = leaf.ids + leaf.count;
        const uint* first_analytic = std::lower_bound(leaf.ids, end, ANALYTIC_BIT);
        const std::size_t first_block = bvh_.blocks.size();
        const int triangle_blocks = add_blocks(leaf.ids, first_analytic);
        const int analytic_blocks = add_blocks(first_analytic, end);
        if (bvh_.blocks.size() > largest_block_count)
            throw SceneError({}, "the scene has too many primitives for one hierarchy (about 2^27); use coarser meshes");
        return ~(static_cast<int>(first_block) << (2 * BVH_LEAF_BLOCK_BITS) | triangle_blocks << BVH_LEAF_BLOCK_BITS | analytic_blocks);
    }

private:
    // Unused lanes repeat the last triangle: a copy loses against its original, and, unlike a degenerate
    // triangle, does not pass for a candidate.
    int add_blocks(const uint* begin, const uint* end)
    {
        int blocks = 0;
        for (; begin < end; begin += BVH_WIDTH, blocks++) {
            BvhBlock block{};
            for (int lane = 0; lane < BVH_WIDTH; lane++) {
                const uint id = std::min(begin + lane, end - 1)[0];
                const bool is_triangle = !(id & ANALYTIC_BIT);
                block.id[lane] = is_triangle || begin + lane < end ? id : NO_PRIMITIVE;
                if (is_triangle) set_triangle(block, lane, id);
            }
            bvh_.blocks.push_back(block);
        }
        return blocks;
    }

    void set_triangle(BvhBlock& block, int lane, uint id) const
    {
        const Triangle& triangle = geometry_.triangles[id];
        for (int k = 0; k < 3; k++) {
            const Vec3 position = geometry_.positions[triangle.vertex[k]];
            for (int axis = 0; axis < 3; axis++) block.vertex[k][axis][lane] = component(position, axis);
        }
    }

    const BvhGeometry& geometry_;
    Bvh& bvh_;
};

} // namespace

int flatten_tree(const BvhGeometry& geometry, const BuildNode& root, Bvh& bvh)
{
    LeafFlattener add_leaf(geometry, bvh);
    return add_tree(root, bvh, add_leaf);
}

int flatten_instance_tree(const BuildNode& root, Bvh& bvh)
{
    const auto add_leaf = [](const BuildLeaf& leaf) {
        assert(leaf.count == 1);
        return ~(static_cast<int>(leaf.ids[0] + 1) << (2 * BVH_LEAF_BLOCK_BITS));
    };
    return add_tree(root, bvh, add_leaf);
}

int join_trees(int first, const Bounds& first_bounds, int second, const Bounds& second_bounds, Bvh& bvh)
{
    BvhNode node = empty_node();
    set_child(node, 0, first_bounds, first);
    set_child(node, 1, second_bounds, second);
    bvh.nodes.push_back(node);
    return static_cast<int>(bvh.nodes.size() - 1);
}

} // namespace sundog
