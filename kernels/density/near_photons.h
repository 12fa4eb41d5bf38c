// Light vertices within a distance of a point, found through the photons that lie on them.
#ifndef SUNDOG_NEAR_PHOTONS_H
#define SUNDOG_NEAR_PHOTONS_H
#include "density/photon_lanes.h"
#include "shared/bidirectional.h"
#include "shared/path.h"
#include "shared/ray.h"

// Whether the path's last vertex can be connected, and its ray has met a surface: that surface then stands in for the light vertices
// near it.
static inline bool stands_in(const PathState* path, const Hit* hit)
{
    return path->depth > 1u && path->pdf_w != PDF_DELTA && hit->primitive != NO_PRIMITIVE;
}

// Which products and sums a compiler joins must not depend on the kernel that asks: a point counted by one is listed by another.
static inline float3 hit_position(Ray ray, float t) { return fma((float3)(t), unpack(ray.direction), unpack(ray.origin)); }

// The same test, of the same numbers, wherever a point is asked for.
static inline bool in_ball(float3 offset, float radius) { return fma(offset.x, offset.x, fma(offset.y, offset.y, offset.z * offset.z)) < radius * radius; }

static inline float8 lengths_in_ball(Offset8 offset) { return fma(offset.x, offset.x, fma(offset.y, offset.y, offset.z * offset.z)); }

// Bits of those of eight photons that lie on a vertex. slots: of all photons, in the map's order.
static inline int lanes_on_vertices(__global const uint* slots, Photons8 photons)
{
    return mask8(photons.mask & (vload8(0, slots + photons.first) != (uint8)(NO_VERTEX)));
}

#endif
