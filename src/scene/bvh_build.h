// Builds the 8-wide hierarchy that kernels/scene/bvh_traverse.h walks.
#pragma once

#include "math/bounds.h"
#include "shared/bvh.h"
#include "shared/geometry.h"

#include <span>
#include <vector>

namespace sundog
{

// Everything a ray can hit, world space. Triangles index positions.
struct BvhGeometry {
    std::span<const Vec3> positions;
    std::span<const Triangle> triangles;
    std::span<const AnalyticPrimitive> analytics;
};

// One tree or, for scenes with instances, several (scene/scene_bvh.h). Empty geometry: no nodes, no blocks, and a root that is an empty leaf.
struct Bvh {
    std::vector<BvhNode> nodes;
    std::vector<BvhBlock> blocks;
    int root = ~0; // as BvhNode::child
    Bounds bounds; // of all primitives
    std::vector<Instance> instances;
};

// A tree in a Bvh.
struct BvhTree {
    int root = ~0; // as BvhNode::child
    Bounds bounds;
};

// The defaults are the fastest of those tried on 10^4 and 10^6 triangles: a block costs the same full or empty, so sets
// of up to eight are kept together.
struct BvhSettings {
    unsigned min_leaf_size = BVH_WIDTH;     // primitives; so few are never split
    unsigned max_leaf_size = 2 * BVH_WIDTH; // primitives, up to 32
    float traversal_cost = 1.0f;            // of a node, relative to
    float intersection_cost = 0.5f;         // a block of eight primitives
    float extra_references = 1.0f;          // room for spatial splits, as a fraction of the primitive count; 0: no splits
};

// The same geometry gives the same bits, whatever the number of processors.
// Triangles without area are left out: no ray hits them, and they have no normal.
//
// Throws SceneError when a coordinate is not finite or beyond 1e12 (whose
// products would overflow on the device) or there are too many primitives, and
// std::logic_error when a triangle's index is out of range.
Bvh build_bvh(const BvhGeometry& geometry, const BvhSettings& settings = {});

// The same beside the trees that `bvh` has already; its root stays.
BvhTree append_tree(Bvh& bvh, const BvhGeometry& geometry, const BvhSettings& settings = {});

// The tree of instances: their boxes (no coordinate beyond 1e12) and indices. Throws SceneError for more than
// BVH_MAX_INSTANCES.
struct BvhPrimitive;
BvhTree append_instance_tree(Bvh& bvh, const std::vector<BvhPrimitive>& instances);

} // namespace sundog
