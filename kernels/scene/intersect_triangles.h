// Watertight intersection of a ray with eight triangles: Woop, Benthin and Wald,
// "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
//
// Vertices are moved to the ray's origin and sheared so that the ray runs along
// one axis; what remains are signs of 2D edge functions. A vertex gets the same
// sheared position in every triangle that shares it, and an edge function is
// exactly antisymmetric, so a ray cannot slip between two triangles: a rounded
// edge function has the exact one's sign or is zero, and zero counts as inside.
#ifndef SUNDOG_INTERSECT_TRIANGLES_H
#define SUNDOG_INTERSECT_TRIANGLES_H
#include "math/simd8.h"
#include "shared/bvh.h"
#include "shared/ray.h"

// A ray prepared for the test. axis_z is the axis along which its direction is
// longest; rows of a block are chosen by axis, which permutes without moves.
typedef struct RayShear {
    int axis_x, axis_y, axis_z;
    float origin_x, origin_y, origin_z; // permuted
    float shear_x, shear_y, shear_z;
} RayShear;

static inline RayShear prepare_shear(Ray ray)
{
    const float x = fabs(ray.direction.x), y = fabs(ray.direction.y), z = fabs(ray.direction.z);
    RayShear shear;
    float along_x, along_y, along_z;
    if (x > y && x > z) {
        shear.axis_x = 1, shear.axis_y = 2, shear.axis_z = 0;
        shear.origin_x = ray.origin.y, shear.origin_y = ray.origin.z, shear.origin_z = ray.origin.x;
        along_x = ray.direction.y, along_y = ray.direction.z, along_z = ray.direction.x;
    } else if (y > z) {
        shear.axis_x = 2, shear.axis_y = 0, shear.axis_z = 1;
        shear.origin_x = ray.origin.z, shear.origin_y = ray.origin.x, shear.origin_z = ray.origin.y;
        along_x = ray.direction.z, along_y = ray.direction.x, along_z = ray.direction.y;
    } else {
        shear.axis_x = 0, shear.axis_y = 1, shear.axis_z = 2;
        shear.origin_x = ray.origin.x, shear.origin_y = ray.origin.y, shear.origin_z = ray.origin.z;
        along_x = ray.direction.x, along_y = ray.direction.y, along_z = ray.direction.z;
    }
    shear.shear_z = 1.0f / along_z;
    shear.shear_x = along_x * shear.shear_z;
    shear.shear_y = along_y * shear.shear_z;
    return shear;
}

// x1 y2 - y1 x2, never contracted: swapping the two points flips the sign and
// changes nothing else.
static inline float8 edge_function(float8 x1, float8 y1, float8 x2, float8 y2)
{
#pragma OPENCL FP_CONTRACT OFF
    const float8 left = x1 * y2;
    const float8 right = y1 * x2;
    return left - right;
}

// Takes the nearest hit of a block with 0 < t <= hit->t into *hit; at equal t the
// lower primitive wins, so the answer does not depend on the order of visits.
// (Lanes of a block are in ascending order of id.) any: returns at the first hit
// without telling which.
static inline bool intersect_triangle_block(__global const BvhBlock* block, const RayShear* shear, bool any, Hit* hit)
{
    __global const float8* rows = (__global const float8*)block;
    __global const float8* rows_x = rows + shear->axis_x;
    __global const float8* rows_y = rows + shear->axis_y;
    __global const float8* rows_z = rows + shear->axis_z;
    const float8 az = rows_z[0] - shear->origin_z, bz = rows_z[3] - shear->origin_z, cz = rows_z[6] - shear->origin_z;
    const float8 ax = (rows_x[0] - shear->origin_x) - shear->shear_x * az;
    const float8 ay = (rows_y[0] - shear->origin_y) - shear->shear_y * az;
    const float8 bx = (rows_x[3] - shear->origin_x) - shear->shear_x * bz;
    const float8 by = (rows_y[3] - shear->origin_y) - shear->shear_y * bz;
    const float8 cx = (rows_x[6] - shear->origin_x) - shear->shear_x * cz;
    const float8 cy = (rows_y[6] - shear->origin_y) - shear->shear_y * cz;

    // Twice the areas that the ray cuts off: scaled barycentric weights of a, b and c.
    const float8 u = edge_function(cx, cy, bx, by);
    const float8 v = edge_function(ax, ay, cx, cy);
    const float8 w = edge_function(bx, by, ax, ay);
    const float8 lowest = min8(min8(u, v), w);
    const float8 highest = max8(max8(u, v), w);
    const int inside = mask8(lowest >= 0.0f) | mask8(highest <= 0.0f);
    if (inside == 0) return false;

    const float8 determinant = u + v + w; // 0: seen edge-on, or degenerate
    const float8 inverse = 1.0f / determinant;
    const float8 t = (u * az + v * bz + w * cz) * shear->shear_z * inverse;
    int accepted = inside & mask8((determinant != 0.0f) & (t > 0.0f) & (t <= hit->t));
    if (accepted == 0) return false;
    if (any) return true;

    float distances[BVH_WIDTH];
    vstore8(t, 0, distances);
    int lane = first_lane(accepted);
    for (accepted &= accepted - 1; accepted != 0; accepted &= accepted - 1)
        if (distances[first_lane(accepted)] < distances[lane]) lane = first_lane(accepted);
    const float nearest = distances[lane];
    const uint id = block->id[lane];
    if (nearest == hit->t && id >= hit->primitive) return false;
    float second[BVH_WIDTH], third[BVH_WIDTH];
    vstore8(v * inverse, 0, second);
    vstore8(w * inverse, 0, third);
    hit->t = nearest;
    hit->u = second[lane];
    hit->v = third[lane];
    hit->primitive = id;
    return true;
}

#endif
