// Light vertices within a distance of a point, found through the photons that lie on them.
#ifndef SUNDOG_NEAR_PHOTONS_H
#define SUNDOG_NEAR_PHOTONS_H
#include "density/photon_grid.h"
#include "density/wanted_photons.h"
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

// Lanes of eight photons of a run that lie in the ball and on a vertex. slots: of all photons, in the map's order.
static inline int near_lanes(__global const float* streams, __global const uint* slots, uint stride, PhotonRun run, uint i, float3 position,
                             float radius)
{
    const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
    const Offset8 offset = photon_offsets(streams, stride, i, position);
    const float8 squared = fma(offset.x, offset.x, fma(offset.y, offset.y, offset.z * offset.z));
    const int8 mask = (squared < radius * radius) & (lane < (int8)((int)(run.end - i)));
    if (!mask8(mask)) return 0;
    return mask8(mask & (vload8(0, slots + i) != (uint8)(NO_VERTEX)));
}

#endif
