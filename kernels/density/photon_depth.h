// The normal of a photon and its number of edges, in one word. Both are exact enough for what asks for them: depths are compared with
// the longest path that is allowed, normals with those of other surfaces.
#ifndef SUNDOG_PHOTON_DEPTH_H
#define SUNDOG_PHOTON_DEPTH_H
#include "math/frame.h"
#include "shared/photon.h"

// A deep photon's normal: two 5-bit octahedral coordinates, the upper bits of pack_normal's; error below 0.12 rad.
#define DEEP_NORMAL_X(normal_depth) (((normal_depth) >> 14 & 0x1fu) << 7 | 0x40u)
#define DEEP_NORMAL_Y(normal_depth) (((normal_depth) >> 19 & 0x1fu) << 19 | 0x40000u)

static inline uint pack_normal_depth(float3 normal, uint depth)
{
    const uint packed = pack_normal(normal);
    if (depth < PHOTON_DEEP) return packed | (depth << PHOTON_DEPTH_SHIFT);
    const uint x = (packed >> 7) & 0x1fu, y = packed >> 19;
    return min(depth - PHOTON_DEEP, PHOTON_MOST_BEYOND) | (x << 14) | (y << 19) | (PHOTON_DEEP << PHOTON_DEPTH_SHIFT);
}

static inline float3 photon_normal(uint normal_depth)
{
    const bool deep = (normal_depth >> PHOTON_DEPTH_SHIFT) == PHOTON_DEEP;
    return unpack_normal(deep ? DEEP_NORMAL_X(normal_depth) | DEEP_NORMAL_Y(normal_depth) : normal_depth);
}

#endif
