// From where a surface can be lit: its normal, in one word, so that a ray can carry it.
#ifndef SUNDOG_SCENE_HORIZON_H
#define SUNDOG_SCENE_HORIZON_H
#include "math/vec3.h"
#include "shared/ray.h"

#define HORIZON_HAS_NORMAL 0x80000000u
#define HORIZON_BOTH_SIDES 0x40000000u

// 15 bits for each coordinate on the octahedron [Cigolle et al. 2014]: within 2e-4 rad. The normal is of unit length.
static inline uint pack_horizon(float3 normal, bool both_sides)
{
    const float3 size = fabs(normal);
    float2 place = normal.xy / (size.x + size.y + size.z);
    if (normal.z < 0.0f) place = copysign(1.0f - fabs(place.yx), place);
    const float2 steps = clamp((place + 1.0f) * 16383.5f + 0.5f, 0.0f, 32767.0f);
    return HORIZON_HAS_NORMAL | (both_sides ? HORIZON_BOTH_SIDES : 0u) | (uint)steps.x << 15 | (uint)steps.y;
}

static inline float3 horizon_normal(uint horizon)
{
    const float2 place = (float2)((float)((horizon >> 15) & 0x7fffu), (float)(horizon & 0x7fffu)) * (2.0f / 32767.0f) - 1.0f;
    float3 normal = (float3)(place, 1.0f - fabs(place.x) - fabs(place.y));
    if (normal.z < 0.0f) normal.xy = copysign(1.0f - fabs(place.yx), place);
    return normalize(normal);
}

#endif
