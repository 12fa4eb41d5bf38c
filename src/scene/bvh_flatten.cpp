#include "scene/bvh_flatten.h"

#include "base/errors.h"
#include "shared/ray.h"

#include <algorithm>

namespace sundog
{
namespace
{

constexpr int empty_leaf = ~0;
// Outside of every scene (build_bvh refuses coordinates beyond 1e12).
constexpr float nowhere = 1e30f;
constexpr std::size_t largest_block_count = std::size_t(1) << (31 - 2 * BVH_LEAF_BLOCK_BITS);

static_assert((BuildLeaf::capacity + BVH_WIDTH - 1) / BVH_WIDTH <= BVH_LEAF_MAX_BLOCKS);

class Flattener
{
public:
    Flattener(const BvhGeometry& geometry, Bvh& bvh) : geometry_(geometry), bvh_(bvh) {}

    int add(const BuildNode& node)
    {
        return node.is_leaf ? add(static_cast<const BuildLeaf&>(node)) : add(static_cast<const BuildInner&>(node));
    }

private:
    int add(const BuildInner& inner)
    {
        const std::size_t index = bvh_.nodes.size();
        bvh_.nodes.emplace_back();
        BvhNode node;
        for (int i = 0; i < BVH_WIDTH; i++) {
            const bool used = i < inner.count;
            const Bounds bounds = used ? inner.bounds[i] : Bounds{{nowhere, nowhere, nowhere}, {nowhere, nowhere, nowhere}};
            node.lower_x[i] = bounds.lower.x, node.upper_x[i] = bounds.upper.x;
            node.lower_y[i] = bounds.lower.y, node.upper_y[i] = bounds.upper.y;
            node.lower_z[i] = bounds.lower.z, node.upper_z[i] = bounds.upper.z;
            node.child[i] = used ? add(*inner.children[i]) : empty_leaf;
            node.unused[i] = 0;
        }
        bvh_.nodes[index] = node;
        return static_cast<int>(index);
    }

    int add(const BuildLeaf& leaf)
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

void flatten_bvh(const BvhGeometry& geometry, const BuildNode& root, Bvh& bvh)
{
    bvh.nodes.clear();
    bvh.blocks.clear();
    bvh.root = Flattener(geometry, bvh).add(root);
}

} // namespace sundog
