// Traversal of the 8-wide hierarchy, one ray a work-item: closest hit and any hit.
//
// Define HAS_ANALYTIC where the scene has spheres or disks.
#ifndef SUNDOG_BVH_TRAVERSE_H
#define SUNDOG_BVH_TRAVERSE_H
#include "math/simd8.h"
#include "scene/intersect_triangles.h"
#include "scene/scene_view.h"
#ifdef HAS_ANALYTIC
#include "scene/intersect_analytic.h"
#endif

// Each level leaves at most all children but one behind.
#define BVH_STACK_SIZE (BVH_MAX_DEPTH * (BVH_WIDTH - 1) + 1)
#define BVH_EMPTY_LEAF (~0)

// A ray prepared for box tests. For each axis: the row of the bound that the ray
// meets first, the inverse direction, and the origins that the bounds it meets
// first and last are measured from.
typedef struct RaySlabs {
    int row_x, row_y, row_z;
    float inverse_x, inverse_y, inverse_z;
    float entry_x, entry_y, entry_z;
    float exit_x, exit_y, exit_z;
} RaySlabs;

// What rounding can add up to, in units of 2^-24 of the distances involved: 5 for
// the reciprocal and its product, 2 for the origin, 1 for direction components
// that were too small, and, since a triangle's test works on rounded vertices,
// 10 for those (Woop et al. 2013, section 4.3). OpenCL lets a division be wrong by 2.5 ulp.
#define SLAB_ERROR (24.0f / 16777216.0f)

// Boxes grow by the bound on all rounding errors, by moving the two origins: no
// box is missed whose triangle the triangle test would report. Directions get
// no component below 2^-26 of the largest: neither infinities nor NaNs arise,
// and what the ray bends by is within the same bound. False when there is
// nothing to trace: a null or NaN direction, or an origin that is not finite.
static inline bool prepare_slabs(Ray ray, float reach, RaySlabs* slabs)
{
    const float x = fabs(ray.direction.x), y = fabs(ray.direction.y), z = fabs(ray.direction.z);
    const float largest = fmax(fmax(x, y), z);
    const float smallest = largest * (1.0f / 67108864.0f);
    if (!(largest > 0.0f && reach < FLT_MAX)) return false;
    slabs->inverse_x = 1.0f / copysign(fmax(x, smallest), ray.direction.x);
    slabs->inverse_y = 1.0f / copysign(fmax(y, smallest), ray.direction.y);
    slabs->inverse_z = 1.0f / copysign(fmax(z, smallest), ray.direction.z);
    slabs->row_x = slabs->inverse_x < 0.0f ? 1 : 0;
    slabs->row_y = slabs->inverse_y < 0.0f ? 3 : 2;
    slabs->row_z = slabs->inverse_z < 0.0f ? 5 : 4;
    const float error = SLAB_ERROR * reach;
    const float error_x = copysign(error, ray.direction.x);
    const float error_y = copysign(error, ray.direction.y);
    const float error_z = copysign(error, ray.direction.z);
    slabs->entry_x = ray.origin.x + error_x, slabs->exit_x = ray.origin.x - error_x;
    slabs->entry_y = ray.origin.y + error_y, slabs->exit_y = ray.origin.y - error_y;
    slabs->entry_z = ray.origin.z + error_z, slabs->exit_z = ray.origin.z - error_z;
    return true;
}

// Mask of the node's children whose boxes the ray enters before t_limit, and where.
static inline int intersect_children(__global const BvhNode* node, const RaySlabs* slabs, float t_limit, float8* t_entry)
{
    __global const float8* rows = (__global const float8*)node;
    const float8 entry_x = (rows[slabs->row_x] - slabs->entry_x) * slabs->inverse_x;
    const float8 entry_y = (rows[slabs->row_y] - slabs->entry_y) * slabs->inverse_y;
    const float8 entry_z = (rows[slabs->row_z] - slabs->entry_z) * slabs->inverse_z;
    const float8 exit_x = (rows[slabs->row_x ^ 1] - slabs->exit_x) * slabs->inverse_x;
    const float8 exit_y = (rows[slabs->row_y ^ 1] - slabs->exit_y) * slabs->inverse_y;
    const float8 exit_z = (rows[slabs->row_z ^ 1] - slabs->exit_z) * slabs->inverse_z;
    const float8 entry = max8(max8(entry_x, entry_y), max8(entry_z, (float8)(0.0f)));
    const float8 exit = min8(min8(exit_x, exit_y), min8(exit_z, (float8)(t_limit)));
    *t_entry = entry;
    return mask8(entry <= exit);
}

typedef struct BvhStack {
    int depth;
    int node[BVH_STACK_SIZE];
    float t[BVH_STACK_SIZE];
} BvhStack;

// Puts the children of `mask` on the stack, the nearest last.
static inline void push_children(BvhStack* stack, __global const BvhNode* node, int mask, const float* t_entry)
{
    const int first = stack->depth;
    while (mask != 0) {
        const int lane = first_lane(mask);
        const float t = t_entry[lane];
        mask &= mask - 1;
        int place = stack->depth++;
        for (; place > first && stack->t[place - 1] < t; place--) {
            stack->node[place] = stack->node[place - 1];
            stack->t[place] = stack->t[place - 1];
        }
        stack->node[place] = node->child[lane];
        stack->t[place] = t;
    }
}

// The child to go on with, the others being left on the stack.
static inline int enter_node(BvhStack* stack, __global const BvhNode* node, const RaySlabs* slabs, float t_limit)
{
    float8 t_entry;
    int mask = intersect_children(node, slabs, t_limit, &t_entry);
    if (mask == 0) return BVH_EMPTY_LEAF;
    const int first = first_lane(mask);
    mask &= mask - 1;
    if (mask == 0) return node->child[first];
    float t[BVH_WIDTH];
    vstore8(t_entry, 0, t);
    const int second = first_lane(mask);
    mask &= mask - 1;
    const int near = t[second] < t[first] ? second : first;
    const int far = near == first ? second : first;
    if (mask == 0) {
        stack->node[stack->depth] = node->child[far];
        stack->t[stack->depth++] = t[far];
        return node->child[near];
    }
    push_children(stack, node, mask | 1 << first | 1 << second, t);
    return stack->node[--stack->depth];
}

// Hits in the triangle blocks of a leaf. *block moves past them.
static inline bool intersect_leaf_triangles(__global const BvhBlock** block, uint code, const RayShear* shear, bool any, Hit* hit)
{
    bool found = false;
    for (uint left = (code >> BVH_LEAF_BLOCK_BITS) & BVH_LEAF_MAX_BLOCKS; left > 0; left--, (*block)++) {
        found |= intersect_triangle_block(*block, shear, any, hit);
        if (any && found) return true;
    }
    return found;
}

// The traversal behind both queries; `any` is a literal where it is called, so
// that each gets its own code.
static inline bool traverse_bvh(GEOMETRY_PARAMETERS, Ray ray, bool any, Hit* hit)
{
    const Vec3 center = globals->center;
    const float reach = fabs(ray.origin.x - center.x) + fabs(ray.origin.y - center.y) + fabs(ray.origin.z - center.z) + globals->radius;
    RaySlabs slabs;
    if (!(ray.t_max > 0.0f) || !prepare_slabs(ray, reach, &slabs)) return false;
    const RayShear shear = prepare_shear(ray);
    // The largest float below t_max: t < t_max becomes t <= hit->t.
    hit->t = as_float(as_uint(ray.t_max) - 1u);

    BvhStack stack;
    stack.depth = 0;
    int node = globals->bvh_root;
    bool found = false;
    for (;;) {
        while (node >= 0) node = enter_node(&stack, bvh_nodes + node, &slabs, hit->t);
        const uint leaf = (uint)~node;
        __global const BvhBlock* block = bvh_blocks + (leaf >> (2 * BVH_LEAF_BLOCK_BITS));
        found |= intersect_leaf_triangles(&block, leaf, &shear, any, hit);
#ifdef HAS_ANALYTIC
        if (!(any && found)) found |= intersect_leaf_analytics(block, leaf, analytics, ray, any, hit);
#endif
        if (any && found) return true;
        do {
            if (stack.depth == 0) return found;
            stack.depth--;
        } while (stack.t[stack.depth] > hit->t);
        node = stack.node[stack.depth];
    }
}

// The nearest point with 0 < t < ray.t_max into *hit, or a miss (NO_PRIMITIVE, t = t_max).
static inline bool intersect_closest(GEOMETRY_PARAMETERS, Ray ray, Hit* hit)
{
    hit->u = 0.0f;
    hit->v = 0.0f;
    hit->primitive = NO_PRIMITIVE;
    const bool found = traverse_bvh(GEOMETRY_ARGUMENTS, ray, false, hit);
    if (!found) hit->t = ray.t_max;
    return found;
}

// Whether there is any surface with 0 < t < ray.t_max.
static inline bool intersect_any(GEOMETRY_PARAMETERS, Ray ray)
{
    Hit hit;
    hit.primitive = NO_PRIMITIVE;
    return traverse_bvh(GEOMETRY_ARGUMENTS, ray, true, &hit);
}

#endif
