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

// Appends to bvh.nodes and bvh.blocks and returns the tree's root, as BvhNode::child. Nodes lie in depth-first order, a
// leaf's blocks together. Throws SceneError when a leaf's code cannot address its blocks.
int flatten_tree(const BvhGeometry& geometry, const BuildNode& root, Bvh& bvh);

// The same for a tree of instances, whose leaves hold the index of one each.
int flatten_instance_tree(const BuildNode& root, Bvh& bvh);

// A node whose children are two trees.
int join_trees(int first, const Bounds& first_bounds, int second, const Bounds& second_bounds, Bvh& bvh);

} // namespace sundog
