// The builder's tree of pointers, and its change into the device's arrays.
#pragma once

#include "scene/bvh_build.h"

#include <cstddef>

namespace sundog
{

struct BuildNode {
    explicit BuildNode(bool leaf) : is_leaf(leaf) {}
    bool is_leaf;
};

struct BuildInner : BuildNode {
    BuildInner() : BuildNode(false) {}
    int count = 0;
    BuildNode* children[BVH_WIDTH];
    Bounds bounds[BVH_WIDTH];
};

// ids: as Hit::primitive, ascending, each once.
struct BuildLeaf : BuildNode {
    static constexpr std::size_t capacity = 32;
    BuildLeaf() : BuildNode(true) {}
    int count = 0;
    uint ids[capacity];
};

// Fills bvh.nodes, bvh.blocks and bvh.root. Nodes lie in depth-first order, a leaf's blocks together.
// Throws SceneError when a leaf's code cannot address its blocks.
void flatten_bvh(const BvhGeometry& geometry, const BuildNode& root, Bvh& bvh);

} // namespace sundog
