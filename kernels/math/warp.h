// From uniform numbers to directions and points; each with its density.
#ifndef SUNDOG_WARP_H
#define SUNDOG_WARP_H
#include "math/vec3.h"

#define PI_F 3.14159265358979f
#define INV_PI_F 0.318309886183791f

// Uniform on the unit disk, by the concentric map [Shirley and Chiu 1997]. Density 1 / pi.
static inline float2 sample_disk(float2 u)
{
    const float2 p = 2.0f * u - 1.0f;
    if (p.x == 0.0f && p.y == 0.0f) return p;
    const bool wide = fabs(p.x) > fabs(p.y);
    const float radius = wide ? p.x : p.y;
    const float angle = wide ? (0.25f * PI_F) * (p.y / p.x) : 0.5f * PI_F - (0.25f * PI_F) * (p.x / p.y);
    return radius * (float2)(native_cos(angle), native_sin(angle));
}

// Cosine-weighted about +z. Density cos / pi (1/sr).
static inline float3 sample_cosine_hemisphere(float2 u)
{
    const float2 p = sample_disk(u);
    return (float3)(p, sqrt(fmax(0.0f, 1.0f - dot(p, p))));
}

// Uniform within the cone about +z whose cosine is cos_max, of `one_minus_cos` = 1 - cos_max, given
// apart because small cones lose it. Density 1 / (2 pi one_minus_cos) (1/sr).
static inline float3 sample_cone(float2 u, float one_minus_cos)
{
    const float h = u.x * one_minus_cos; // 1 - cos theta
    const float sin_theta = sqrt(fmax(0.0f, h * (2.0f - h)));
    const float phi = PI_F * (2.0f * u.y - 1.0f);
    return (float3)(sin_theta * native_cos(phi), sin_theta * native_sin(phi), 1.0f - h);
}

// Uniform on the unit sphere. Density 1 / (4 pi) (1/sr).
static inline float3 sample_sphere(float2 u) { return sample_cone(u, 2.0f); }

// Uniform on a triangle: barycentric weights of its second and third vertex [Heitz 2019]. Density 1 / area.
static inline float2 sample_triangle(float2 u)
{
    const float2 half_u = 0.5f * u;
    const float offset = half_u.y - half_u.x;
    return offset > 0.0f ? (float2)(half_u.x, half_u.y + offset) : (float2)(half_u.x - offset, half_u.y);
}

#endif
