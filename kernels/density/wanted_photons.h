// Which photons count for a query, wherever they lie: those of its side of the surface that make no path too long.
#ifndef SUNDOG_WANTED_PHOTONS_H
#define SUNDOG_WANTED_PHOTONS_H
#include "density/photon_depth.h"
#include "math/simd8.h"
#include "math/vec3.h"
#include "shared/photon.h"

// Photons whose normal is further than this from the query's lie on another surface.
#define MIN_NORMAL_COSINE 0.7f

// Eight vectors, not of unit length, of octahedral points.
static inline Offset8 unfold_octahedral(float8 x, float8 y)
{
    const float8 z = 1.0f - fabs(x) - fabs(y);
    const float8 fold = z < 0.0f ? -z : (float8)(0.0f);
    const Offset8 v = {x - copysign(fold, x), y - copysign(fold, y), z};
    return v;
}

// Eight unit vectors that pack_direction packed.
static inline Offset8 unpack_directions(uint8 packed)
{
    const float8 x = convert_float8(as_int8(packed & 0xffffu)) * (1.0f / 32768.0f) + (0.5f / 32768.0f - 1.0f);
    const float8 y = convert_float8(as_int8(packed >> 16)) * (1.0f / 32768.0f) + (0.5f / 32768.0f - 1.0f);
    const Offset8 v = unfold_octahedral(x, y);
    const float8 scale = 1.0f / sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    const Offset8 unit = {v.x * scale, v.y * scale, v.z * scale};
    return unit;
}

// Eight normals as pack_normal packs them, and eight numbers of edges (density/photon_depth.h).
static inline uint8 photon_normals(uint8 normal_depth)
{
    const int8 deep = as_int8((normal_depth >> PHOTON_DEPTH_SHIFT) == PHOTON_DEEP);
    return mask8(deep) ? select(normal_depth, DEEP_NORMAL_X(normal_depth) | DEEP_NORMAL_Y(normal_depth), as_uint8(deep)) : normal_depth;
}

static inline uint8 photon_depths(uint8 normal_depth)
{
    const uint8 depth = normal_depth >> PHOTON_DEPTH_SHIFT;
    const int8 deep = as_int8(depth == PHOTON_DEEP);
    return mask8(deep) ? select(depth, PHOTON_DEEP + (normal_depth & PHOTON_MOST_BEYOND), as_uint8(deep)) : depth;
}

// Lanes whose packed normal is close to the query's (or, for a lobe that transmits, to its opposite): n . m > c |m| for the
// unnormalised octahedral m, c being `least`.
static inline int8 on_same_side(uint8 normal_depth, float3 normal, bool both_sides, float least)
{
    const uint8 packed = photon_normals(normal_depth);
    const float8 x = convert_float8(as_int8(packed & 0xfffu)) * (1.0f / 2048.0f) - (2047.5f / 2048.0f);
    const float8 y = convert_float8(as_int8((packed >> 12) & 0xfffu)) * (1.0f / 2048.0f) - (2047.5f / 2048.0f);
    const Offset8 m = unfold_octahedral(x, y);
    const float8 cosine = m.x * normal.x + m.y * normal.y + m.z * normal.z;
    return ((cosine > 0.0f) | (int8)(both_sides ? -1 : 0)) & (cosine * cosine > (least * least) * (m.x * m.x + m.y * m.y + m.z * m.z));
}

// Lanes that the query asks for, whose photons make no path too long.
static inline int8 wanted(uint8 normal_depth, const GatherQuery* query)
{
    int8 mask = on_same_side(normal_depth, unpack(query->normal), (query->flags & QUERY_BOTH_SIDES) != 0u, MIN_NORMAL_COSINE);
    mask &= as_int8(photon_depths(normal_depth) <= query->max_photon_depth);
    if (query->flags & QUERY_UNREACHED_ONLY) mask &= as_int8((normal_depth & PHOTON_UNREACHED) != 0u);
    return mask;
}

#endif
