// Instances: copies of a group of shapes, each with an affine map from the group's space into the world's.
#ifndef SUNDOG_INSTANCE_SPACE_H
#define SUNDOG_INSTANCE_SPACE_H
#include "math/vec3.h"
#include "shared/bvh.h"
#include "shared/geometry.h"
#include "shared/ray.h"

// Leaves without blocks, but for the empty one, are instances.
static inline bool is_instance_leaf(uint code)
{
    return code != 0u && (code & ((1u << (2 * BVH_LEAF_BLOCK_BITS)) - 1u)) == 0u;
}

static inline uint instance_of_leaf(uint code)
{
    return (code >> (2 * BVH_LEAF_BLOCK_BITS)) - 1u;
}

static inline float3 to_world_vector(__global const Instance* instance, float3 v)
{
    return (float3)(dot(unpack(instance->to_world[0]), v), dot(unpack(instance->to_world[1]), v), dot(unpack(instance->to_world[2]), v));
}

static inline float3 to_object_vector(__global const Instance* instance, float3 v)
{
    return (float3)(dot(unpack(instance->to_object[0]), v), dot(unpack(instance->to_object[1]), v), dot(unpack(instance->to_object[2]), v));
}

// The direction is not normalised: t stays what it is in the world.
static inline Ray ray_in_object_space(__global const Instance* instance, Ray ray)
{
    Ray moved = ray;
    moved.origin = pack(to_object_vector(instance, unpack(ray.origin) - unpack(instance->translation)));
    moved.direction = pack(to_object_vector(instance, unpack(ray.direction)));
    return moved;
}

// Not of unit length. By the inverse transpose: what was outside stays outside under reflections too.
static inline float3 to_world_normal(__global const Instance* instance, float3 n)
{
    return unpack(instance->to_object[0]) * n.x + unpack(instance->to_object[1]) * n.y + unpack(instance->to_object[2]) * n.z;
}

// Bounds of the components of a linear map's result, for vectors whose components are bounded by `extent`.
static inline float3 to_world_extent(__global const Instance* instance, float3 extent)
{
    return (float3)(dot(fabs(unpack(instance->to_world[0])), extent), dot(fabs(unpack(instance->to_world[1])), extent),
                    dot(fabs(unpack(instance->to_world[2])), extent));
}

static inline float3 to_object_extent(__global const Instance* instance, float3 extent)
{
    return (float3)(dot(fabs(unpack(instance->to_object[0])), extent), dot(fabs(unpack(instance->to_object[1])), extent),
                    dot(fabs(unpack(instance->to_object[2])), extent));
}

#endif
