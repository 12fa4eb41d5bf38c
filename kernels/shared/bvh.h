// The 8-wide bounding volume hierarchy. Structure of arrays inside a node and
// inside a block of triangles, so that one work-item tests eight at a time.
#ifndef SUNDOG_SHARED_BVH_H
#define SUNDOG_SHARED_BVH_H
#include "shared/platform.h"
SHARED_BEGIN

#define BVH_WIDTH 8
// Depth that the builder guarantees; bounds the traversal stack.
#define BVH_MAX_DEPTH 40

// Children: >= 0 an inner node's index; < 0 a leaf whose code is ~child (below).
// Unused slots carry bounds at large positive coordinates, which hardly a ray
// enters, and an empty leaf.
typedef struct BvhNode {
    float lower_x[BVH_WIDTH], upper_x[BVH_WIDTH];
    float lower_y[BVH_WIDTH], upper_y[BVH_WIDTH];
    float lower_z[BVH_WIDTH], upper_z[BVH_WIDTH];
    int child[BVH_WIDTH];
    int unused[BVH_WIDTH];
} BvhNode;
SHARED_SIZE(BvhNode, 256);

// A leaf's code: first_block << 6 | triangle_blocks << 3 | analytic_blocks.
// Its triangle blocks come first, its analytic blocks follow. A leaf without blocks
// is empty (code 0) or an instance: (index + 1) << 6.
#define BVH_LEAF_BLOCK_BITS 3
#define BVH_LEAF_MAX_BLOCKS 7
#define BVH_MAX_INSTANCES ((1u << (31 - 2 * BVH_LEAF_BLOCK_BITS)) - 2u)

// Scenes with instances: the root chooses between the world's own tree and the
// tree of instances, whose leaves lead to the tree of a group.
#define BVH_MAX_DEPTH_INSTANCED (2 * BVH_MAX_DEPTH + 1)

// Eight triangles, or the indices of eight analytic primitives (then only `id`
// is used). vertex[k][axis][lane]; ids ascend. Unused lanes repeat the last
// triangle, or hold NO_PRIMITIVE among analytic primitives.
typedef struct BvhBlock {
    float vertex[3][3][BVH_WIDTH];
    uint id[BVH_WIDTH];
} BvhBlock;
SHARED_SIZE(BvhBlock, 320);

SHARED_END
#endif
