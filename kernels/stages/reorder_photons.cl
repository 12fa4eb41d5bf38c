// Lays photons out in cell order, as structure of arrays. Reads photons and their order (-D IN_ORDER=1: they are
// in order already); writes the streams, up to seven places beyond the last photon. One work-item eight photons:
// whole records come in, whole vectors go out, which is what memory likes on both sides.
#include "shared/photon.h"

#if IN_ORDER
#define PLACE_(i) (i)
#else
#define PLACE_(i) order[i]
#endif

#define COLUMN_(i) (float8)(p0.s##i, p1.s##i, p2.s##i, p3.s##i, p4.s##i, p5.s##i, p6.s##i, p7.s##i)

__kernel void reorder_photons(__global const Photon* restrict photons, __global const uint* restrict order, __global const uint* restrict photon_count, uint stride,
                              __global float* restrict streams)
{
    const uint first = get_global_id(0) * 8u;
    const uint count = *photon_count;
    if (first >= count) return;
    const uint last = count - 1u; // lanes beyond repeat it
    __global const float* records = (__global const float*)photons;
    const float8 p0 = vload8(PLACE_(first), records);
    const float8 p1 = vload8(PLACE_(min(first + 1u, last)), records);
    const float8 p2 = vload8(PLACE_(min(first + 2u, last)), records);
    const float8 p3 = vload8(PLACE_(min(first + 3u, last)), records);
    const float8 p4 = vload8(PLACE_(min(first + 4u, last)), records);
    const float8 p5 = vload8(PLACE_(min(first + 5u, last)), records);
    const float8 p6 = vload8(PLACE_(min(first + 6u, last)), records);
    const float8 p7 = vload8(PLACE_(min(first + 7u, last)), records);
    // The order of a Photon's members: position, direction, flux, normal and depth.
    vstore8(COLUMN_(0), 0, streams + (size_t)PHOTON_X * stride + first);
    vstore8(COLUMN_(1), 0, streams + (size_t)PHOTON_Y * stride + first);
    vstore8(COLUMN_(2), 0, streams + (size_t)PHOTON_Z * stride + first);
    vstore8(COLUMN_(3), 0, streams + (size_t)PHOTON_DIRECTION * stride + first);
    vstore8(COLUMN_(4), 0, streams + (size_t)PHOTON_RED * stride + first);
    vstore8(COLUMN_(5), 0, streams + (size_t)PHOTON_GREEN * stride + first);
    vstore8(COLUMN_(6), 0, streams + (size_t)PHOTON_BLUE * stride + first);
    vstore8(COLUMN_(7), 0, streams + (size_t)PHOTON_NORMAL_DEPTH * stride + first);
}
