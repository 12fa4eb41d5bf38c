// Packed triples in memory, float3 in registers.
#ifndef SUNDOG_VEC3_H
#define SUNDOG_VEC3_H
#include "shared/vec3.h"

static inline float3 unpack(Vec3 v) { return (float3)(v.x, v.y, v.z); }
static inline Vec3 pack(float3 v)
{
    Vec3 packed = {v.x, v.y, v.z};
    return packed;
}

static inline float squared(float x) { return x * x; }
static inline float max3(float3 v) { return fmax(v.x, fmax(v.y, v.z)); }
static inline bool is_black(float3 v) { return v.x == 0.0f && v.y == 0.0f && v.z == 0.0f; }
static inline bool is_finite3(float3 v) { return isfinite(v.x + v.y + v.z); }

#endif
