// Orthonormal frames and the packing of directions.
#ifndef SUNDOG_FRAME_H
#define SUNDOG_FRAME_H
#include "math/vec3.h"

typedef struct Frame {
    float3 s, t, n;
} Frame;

// [Duff et al. 2017, Building an Orthonormal Basis, Revisited]. n: unit length.
static inline Frame make_frame(float3 n)
{
    const float sign = copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    Frame frame;
    frame.s = (float3)(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    frame.t = (float3)(b, sign + n.y * n.y * a, -n.y);
    frame.n = n;
    return frame;
}

static inline float3 to_world(Frame frame, float3 v) { return frame.s * v.x + frame.t * v.y + frame.n * v.z; }

// Unit vector on the octahedron, folded to the square [-1, 1]^2 [Cigolle et al. 2014].
static inline float2 octahedral(float3 v)
{
    const float scale = 1.0f / (fabs(v.x) + fabs(v.y) + fabs(v.z));
    float2 p = v.xy * scale;
    if (v.z < 0.0f) p = (1.0f - fabs(p.yx)) * copysign((float2)(1.0f), p);
    return p;
}

// Two 16-bit octahedral coordinates, each the number q of its cell, which stands for (q + 1/2) / 2^15 - 1; error
// below 1e-4 rad.
static inline uint pack_direction(float3 v)
{
    const uint2 q = convert_uint2(clamp(octahedral(v) * 32768.0f + 32768.0f, 0.0f, 65535.0f));
    return q.x | (q.y << 16);
}

// Unit vector of an octahedral point.
static inline float3 from_octahedral(float2 p)
{
    const float z = 1.0f - fabs(p.x) - fabs(p.y);
    if (z < 0.0f) p = (1.0f - fabs(p.yx)) * copysign((float2)(1.0f), p);
    return normalize((float3)(p, z));
}

static inline float3 unpack_direction(uint packed)
{
    const float2 q = (float2)((float)(packed & 0xffffu), (float)(packed >> 16));
    return from_octahedral((q + 0.5f) * (1.0f / 32768.0f) - 1.0f);
}

// The same with two 12-bit coordinates, (q + 1/2) / 2^11 - 1, in the low 24 bits; error below 1.2e-3 rad.
static inline uint pack_normal(float3 v)
{
    const uint2 q = convert_uint2(clamp(octahedral(v) * 2048.0f + 2048.0f, 0.0f, 4095.0f));
    return q.x | (q.y << 12);
}

static inline float3 unpack_normal(uint packed)
{
    const float2 q = (float2)((float)(packed & 0xfffu), (float)((packed >> 12) & 0xfffu));
    return from_octahedral((q + 0.5f) * (1.0f / 2048.0f) - 1.0f);
}

#endif
