// Intersection of a ray with spheres, disks and cylinders.
#ifndef SUNDOG_INTERSECT_ANALYTIC_H
#define SUNDOG_INTERSECT_ANALYTIC_H
#include "math/vec3.h"
#include "shared/bvh.h"
#include "shared/geometry.h"
#include "shared/ray.h"

// Where |from_center + t * direction| is the radius: the lower t and the higher,
// INFINITY both where it never is. The discriminant comes from the ray's closest
// approach to the centre, which does not cancel for small or far spheres, and
// the roots from the form without subtraction: Haines, Guenther and Akenine-
// Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing
// Gems, 2019, ch. 7.
static inline float2 distances_at_radius(float3 from_center, float3 direction, float radius)
{
    const float a = dot(direction, direction);
    const float b = -dot(from_center, direction);
    const float3 closest = from_center + (b / a) * direction;
    const float discriminant = radius * radius - dot(closest, closest);
    if (!(discriminant >= 0.0f)) return (float2)(INFINITY);
    const float distance = sqrt(dot(from_center, from_center));
    const float c = (distance - radius) * (distance + radius);
    const float q = b + copysign(sqrt(a * discriminant), b);
    const float t0 = q == 0.0f ? 0.0f : c / q; // q = 0: a tangent that starts at the sphere
    const float t1 = q / a;
    return t0 < t1 ? (float2)(t0, t1) : (float2)(t1, t0);
}

// Smallest t > 0, or INFINITY.
static inline float intersect_sphere(float3 origin, float3 direction, float3 center, float radius)
{
    const float2 t = distances_at_radius(origin - center, direction, radius);
    return t.x > 0.0f ? t.x : t.y > 0.0f ? t.y : INFINITY;
}

// Smallest t > 0 between the ends, or INFINITY. Across the axis a cylinder is a
// circle; a ray along the axis misses.
static inline float intersect_cylinder(float3 origin, float3 direction, float3 start, float3 axis, float length, float radius)
{
    const float3 from_start = origin - start;
    const float height = dot(from_start, axis), slope = dot(direction, axis);
    const float3 across = direction - slope * axis;
    if (dot(across, across) == 0.0f) return INFINITY;
    const float2 t = distances_at_radius(from_start - height * axis, across, radius);
    const float low = height + t.x * slope, high = height + t.y * slope;
    if (t.x > 0.0f && low >= 0.0f && low <= length) return t.x;
    return t.y > 0.0f && high >= 0.0f && high <= length ? t.y : INFINITY;
}

// t > 0, or INFINITY. The axes span the disk but need not be orthogonal: an
// ellipse under shear. A ray in the disk's plane misses.
static inline float intersect_disk(float3 origin, float3 direction, float3 center, float3 axis_u, float3 axis_v, float3 normal)
{
    const float slope = dot(normal, direction);
    if (slope == 0.0f) return INFINITY;
    const float3 to_center = center - origin;
    const float t = dot(normal, to_center) / slope;
    if (!(t > 0.0f)) return INFINITY;
    // Coordinates in the two axes by the normal equations.
    const float3 offset = t * direction - to_center;
    const float uu = dot(axis_u, axis_u), uv = dot(axis_u, axis_v), vv = dot(axis_v, axis_v);
    const float pu = dot(offset, axis_u), pv = dot(offset, axis_v);
    const float inverse = 1.0f / (uu * vv - uv * uv);
    const float a = (pu * vv - pv * uv) * inverse;
    const float b = (pv * uu - pu * uv) * inverse;
    return a * a + b * b <= 1.0f ? t : INFINITY;
}

static inline float intersect_analytic_primitive(AnalyticPrimitive primitive, Ray ray)
{
    const float3 origin = unpack(ray.origin), direction = unpack(ray.direction), center = unpack(primitive.center);
    if (primitive.kind == ANALYTIC_SPHERE) return intersect_sphere(origin, direction, center, primitive.radius);
    if (primitive.kind == ANALYTIC_CYLINDER)
        return intersect_cylinder(origin, direction, center, unpack(primitive.normal), primitive.length, primitive.radius);
    return intersect_disk(origin, direction, center, unpack(primitive.axis_u), unpack(primitive.axis_v), unpack(primitive.normal));
}

// Hits in the analytic blocks of a leaf, of which `block` is the first. As
// intersect_triangle_block: 0 < t <= hit->t, and the lower primitive at equal t.
static inline bool intersect_leaf_analytics(__global const BvhBlock* block, uint code, __global const AnalyticPrimitive* analytics, Ray ray,
                                            bool any, Hit* hit)
{
    bool found = false;
    const uint slots = (code & BVH_LEAF_MAX_BLOCKS) * BVH_WIDTH;
    for (uint slot = 0; slot < slots; slot++) {
        const uint id = block[slot / BVH_WIDTH].id[slot % BVH_WIDTH];
        if (id == NO_PRIMITIVE) break; // only the last block has unused slots
        const float t = intersect_analytic_primitive(analytics[id & ~ANALYTIC_BIT], ray);
        if (!(t < hit->t || (t == hit->t && id < hit->primitive))) continue;
        if (any) return true;
        hit->t = t;
        hit->u = 0.0f;
        hit->v = 0.0f;
        hit->primitive = id;
        found = true;
    }
    return found;
}

#endif
