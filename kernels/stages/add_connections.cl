// Adds what the connections of each camera vertex bring where their shadow rays are free, in order. Reads each item's first
// place (and the next item's), and the connections at places [window, window + count); updates radiance. One work-item an active
// path. Used by the bidirectional methods.
#include "math/vec3.h"

__kernel void add_connections(__global const uint* restrict active, __global const uint* restrict active_count,
                              __global const uint* restrict firsts, uint window, uint count, __global const uint* restrict occluded,
                              __global const Vec3* restrict connected, __global Vec3* restrict radiance)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint begin = max(firsts[item], window), end = min(firsts[item + 1u], window + count);
    if (begin >= end) return;
    float3 sum = (float3)(0.0f);
    for (uint place = begin; place < end; ++place)
        if (!occluded[place - window]) sum += unpack(connected[place - window]);
    const uint path = active[item];
    radiance[path] = pack(unpack(radiance[path]) + sum);
}
