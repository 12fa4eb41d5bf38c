// Traversal of the 8-wide hierarchy, one ray a work-item: closest hit and any hit.
//
// Define HAS_ANALYTIC where the scene has spheres, disks or cylinders, HAS_INSTANCES
// where it has instances.
#ifndef SUNDOG_BVH_TRAVERSE_H
#define SUNDOG_BVH_TRAVERSE_H
#include "math/simd8.h"
#include "scene/intersect_triangles.h"
#include "scene/scene_view.h"
#ifdef HAS_ANALYTIC
#include "scene/intersect_analytic.h"
#endif
#ifdef HAS_INSTANCES
#include "scene/instance_space.h"
#endif

// GEOMETRY_ARGUMENTS as functions take them: without restrict, whose scopes
// oclgrind does not know once a function is inlined.
#define AS_POINTER_(type, name) , __global const type* name
#define GEOMETRY_POINTERS __global const SceneGlobals* globals GEOMETRY_ARRAYS(AS_POINTER_)

// Each level leaves at most all children but one behind.
#ifdef HAS_INSTANCES
#define BVH_STACK_SIZE (BVH_MAX_DEPTH_INSTANCED * (BVH_WIDTH - 1) + 1)
#else
#define BVH_STACK_SIZE (BVH_MAX_DEPTH * (BVH_WIDTH - 1) + 1)
#endif
#define BVH_EMPTY_LEAF (~0)

// A ray prepared for box tests. For each axis: where in a node the bounds that
// the ray meets first and last are (bytes), the inverse direction, and by how
// much t is stretched at both ends.
typedef struct RaySlabs {
    ulong near_x, near_y, near_z;
    ulong far_x, far_y, far_z;
    float inverse_x, inverse_y, inverse_z;
    float margin_x, margin_y, margin_z;
} RaySlabs;

#define BVH_ROW_BYTES (4 * BVH_WIDTH)

// What rounding can add up to, in units of 2^-24 of the distances involved: 5 for
// the reciprocal and its product, 2 for the origin, 1 for direction components
// that were too small, and, since a triangle's test works on rounded vertices,
// 10 for those (Woop et al. 2013, section 4.3). OpenCL lets a division be wrong by 2.5 ulp.
#define SLAB_ERROR (24.0f / 16777216.0f)

// Boxes grow by the bound on all rounding errors, `reach` being the largest
// distance involved: no box is missed whose triangle the triangle test would
// report. Everything is relative to the ray's origin, so a scene far from the
// coordinates' origin loses nothing. Directions get no component below 2^-26 of
// the largest: neither infinities nor NaNs arise, and what the ray bends by is
// within the same bound. False when there is nothing to trace: a null or NaN
// direction, or an origin that is not finite.
static inline bool prepare_slabs(Ray ray, float reach, RaySlabs* slabs)
{
    const float x = fabs(ray.direction.x), y = fabs(ray.direction.y), z = fabs(ray.direction.z);
    const float largest = fmax(fmax(x, y), z);
    const float smallest = largest * (1.0f / 67108864.0f);
    if (!(largest > 0.0f && reach < FLT_MAX)) return false;
    slabs->inverse_x = 1.0f / copysign(fmax(x, smallest), ray.direction.x);
    slabs->inverse_y = 1.0f / copysign(fmax(y, smallest), ray.direction.y);
    slabs->inverse_z = 1.0f / copysign(fmax(z, smallest), ray.direction.z);
    slabs->near_x = (slabs->inverse_x < 0.0f ? 1 : 0) * BVH_ROW_BYTES;
    slabs->far_x = (slabs->inverse_x < 0.0f ? 0 : 1) * BVH_ROW_BYTES;
    slabs->near_y = (slabs->inverse_y < 0.0f ? 3 : 2) * BVH_ROW_BYTES;
    slabs->far_y = (slabs->inverse_y < 0.0f ? 2 : 3) * BVH_ROW_BYTES;
    slabs->near_z = (slabs->inverse_z < 0.0f ? 5 : 4) * BVH_ROW_BYTES;
    slabs->far_z = (slabs->inverse_z < 0.0f ? 4 : 5) * BVH_ROW_BYTES;
    const float error = SLAB_ERROR * reach;
    slabs->margin_x = error * fabs(slabs->inverse_x);
    slabs->margin_y = error * fabs(slabs->inverse_y);
    slabs->margin_z = error * fabs(slabs->inverse_z);
    return true;
}

// Eight bounds of a node.
static inline float8 node_row(__global const BvhNode* node, ulong offset)
{
    return *(__global const float8*)((__global const char*)node + offset);
}

// Mask of the node's children whose boxes the ray enters before t_limit, and where.
static inline int intersect_children(__global const BvhNode* node, Vec3 origin, const RaySlabs* slabs, float t_limit, float8* t_entry)
{
    const float8 entry_x = (node_row(node, slabs->near_x) - origin.x) * slabs->inverse_x - slabs->margin_x;
    const float8 entry_y = (node_row(node, slabs->near_y) - origin.y) * slabs->inverse_y - slabs->margin_y;
    const float8 entry_z = (node_row(node, slabs->near_z) - origin.z) * slabs->inverse_z - slabs->margin_z;
    const float8 exit_x = (node_row(node, slabs->far_x) - origin.x) * slabs->inverse_x + slabs->margin_x;
    const float8 exit_y = (node_row(node, slabs->far_y) - origin.y) * slabs->inverse_y + slabs->margin_y;
    const float8 exit_z = (node_row(node, slabs->far_z) - origin.z) * slabs->inverse_z + slabs->margin_z;
    const float8 entry = max8(max8(entry_x, entry_y), max8(entry_z, (float8)(0.0f)));
    const float8 exit = min8(min8(exit_x, exit_y), min8(exit_z, (float8)(t_limit)));
    *t_entry = entry;
    return mask8(entry <= exit);
}

// A subtree still to be visited, and where the ray enters it.
typedef struct BvhVisit {
    int node;
    float t;
} BvhVisit;

// Puts the children of `mask` on the stack above `base` in order of distance, the
// farthest lowest, and returns the nearest of them and `near`.
static inline int push_in_order(BvhVisit* stack, int* depth, int base, __global const BvhNode* node, int mask, const float* t,
                                BvhVisit near)
{
    while (mask != 0) {
        const int lane = first_lane(mask);
        mask &= mask - 1;
        BvhVisit visit = {node->child[lane], t[lane]};
        if (visit.t < near.t) {
            const BvhVisit other = near;
            near = visit;
            visit = other;
        }
        int place = (*depth)++;
        for (; place > base && stack[place - 1].t < visit.t; place--) stack[place] = stack[place - 1];
        stack[place] = visit;
    }
    return near.node;
}

// The child to go on with: the nearest; the others are left on the stack, nearer
// ones higher. An any-hit query takes them in any order: sorting does not pay.
static inline int enter_node(BvhVisit* stack, int* depth, __global const BvhNode* node, Vec3 origin, const RaySlabs* slabs, float t_limit,
                             bool any)
{
    float8 t_entry;
    int mask = intersect_children(node, origin, slabs, t_limit, &t_entry);
    if (mask == 0) return BVH_EMPTY_LEAF;
    const int first = first_lane(mask);
    mask &= mask - 1;
    if (mask == 0) return node->child[first];
    if (any) {
        for (; mask != 0; mask &= mask - 1) stack[(*depth)++].node = node->child[first_lane(mask)];
        return node->child[first];
    }
    float t[BVH_WIDTH];
    vstore8(t_entry, 0, t);
    const int second = first_lane(mask);
    mask &= mask - 1;
    const bool swap = t[second] < t[first];
    const BvhVisit near = {node->child[swap ? second : first], t[swap ? second : first]};
    const BvhVisit far = {node->child[swap ? first : second], t[swap ? first : second]};
    const int base = *depth;
    stack[(*depth)++] = far;
    return push_in_order(stack, depth, base, node, mask, t, near);
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

// Starts to load the visit after the next: +3 to +8% on a million triangles.
static inline void prefetch_visit(__global const BvhNode* bvh_nodes, __global const BvhBlock* bvh_blocks, int node)
{
    if (node >= 0)
        prefetch_lines(bvh_nodes + node, 4u);
    else
        prefetch_lines(bvh_blocks + ((uint)~node >> (2 * BVH_LEAF_BLOCK_BITS)), 4u);
}

// A ray with all that the tests of boxes and triangles need of it.
typedef struct PreparedRay {
    Ray ray;
    RaySlabs slabs;
    RayShear shear;
} PreparedRay;

// For geometry within a sphere. False as prepare_slabs.
static inline bool prepare_ray(Ray ray, Vec3 center, float radius, PreparedRay* prepared)
{
    const float reach = fabs(ray.origin.x - center.x) + fabs(ray.origin.y - center.y) + fabs(ray.origin.z - center.z) + radius;
    prepared->ray = ray;
    if (!prepare_slabs(ray, reach, &prepared->slabs)) return false;
    prepared->shear = prepare_shear(ray);
    return true;
}

// The next visit from the stack, or false: nothing is left that is nearer than the hit.
static inline bool pop_visit(const BvhVisit* stack, int* depth, bool any, float t_limit, int* node)
{
    do {
        if (*depth == 0) return false;
        (*depth)--;
    } while (!any && stack[*depth].t > t_limit);
    *node = stack[*depth].node;
    return true;
}

// The traversal behind both queries; `any` is a literal where it is called, so
// that each gets its own code. Instances are entered as they are met: the ray goes on in
// the group's space, where t is the same, until the stack is down to where it was.
static inline bool traverse_bvh(GEOMETRY_POINTERS, Ray ray, bool any, Hit* hit)
{
    PreparedRay current;
    if (!(ray.t_max > 0.0f) || !prepare_ray(ray, globals->center, globals->radius, &current)) return false;
    // The largest float below t_max: t < t_max becomes t <= hit->t.
    hit->t = as_float(as_uint(ray.t_max) - 1u);

    BvhVisit stack[BVH_STACK_SIZE];
    int depth = 0;
#ifdef HIDE_EMITTERS
    int node = ray.horizon == RAY_FROM_LENS ? bvh_nodes[globals->bvh_root].child[0] : globals->bvh_root;
#else
    int node = globals->bvh_root;
#endif
    bool found = false;
#ifdef HAS_INSTANCES
    const PreparedRay in_world = current;
    uint instance = NO_INSTANCE;
    int world_depth = 0; // of the stack where the instance was entered
#endif
    for (;;) {
        while (node >= 0) node = enter_node(stack, &depth, bvh_nodes + node, current.ray.origin, &current.slabs, hit->t, any);
        const uint leaf = (uint)~node;
#ifdef HAS_INSTANCES
        if (is_instance_leaf(leaf)) {
            __global const Instance* entered = instances + instance_of_leaf(leaf);
            if (prepare_ray(ray_in_object_space(entered, ray), entered->center, entered->radius, &current)) {
                instance = instance_of_leaf(leaf);
                world_depth = depth;
                node = entered->root;
                continue;
            }
            current = in_world;
        }
#endif
        __global const BvhBlock* block = bvh_blocks + (leaf >> (2 * BVH_LEAF_BLOCK_BITS));
        bool found_here = intersect_leaf_triangles(&block, leaf, &current.shear, any, hit);
#ifdef HAS_ANALYTIC
        if (!(any && found_here)) found_here |= intersect_leaf_analytics(block, leaf, analytics, current.ray, any, hit);
#endif
        if (any && found_here) return true;
        found |= found_here;
#ifdef HAS_INSTANCES
        if (found_here) hit->instance = instance;
#endif
        if (!pop_visit(stack, &depth, any, hit->t, &node)) return found;
#ifdef HAS_INSTANCES
        if (instance != NO_INSTANCE && depth < world_depth) {
            instance = NO_INSTANCE;
            current = in_world;
        }
#endif
        if (depth > 0) prefetch_visit(bvh_nodes, bvh_blocks, stack[depth - 1].node);
    }
}

// The nearest point with 0 < t < ray.t_max into *hit, or a miss (NO_PRIMITIVE, t = t_max).
static inline bool intersect_closest(GEOMETRY_POINTERS, Ray ray, Hit* hit)
{
    hit->u = 0.0f;
    hit->v = 0.0f;
    hit->primitive = NO_PRIMITIVE;
    hit->instance = NO_INSTANCE;
    const bool found = traverse_bvh(GEOMETRY_ARGUMENTS, ray, false, hit);
    if (!found) hit->t = ray.t_max;
    return found;
}

// Whether there is any surface with 0 < t < ray.t_max.
static inline bool intersect_any(GEOMETRY_POINTERS, Ray ray)
{
    Hit hit;
    hit.primitive = NO_PRIMITIVE;
    return traverse_bvh(GEOMETRY_ARGUMENTS, ray, true, &hit);
}

#endif
