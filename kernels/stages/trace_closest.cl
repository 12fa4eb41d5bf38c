// The nearest hit of each active path's ray.
//
// Reads rays; writes hits (a miss: NO_PRIMITIVE). One work-item an entry of
// `active`, the list of path indices, of which the first *count count. Rays and
// hits are indexed by path. Used by every method.
#include "scene/bvh_traverse.h"

__kernel void trace_closest(GEOMETRY_PARAMETERS, __global const Ray* restrict rays, __global Hit* restrict hits,
                            __global const uint* restrict active, __global const uint* restrict count)
{
    const uint index = (uint)get_global_id(0);
    if (index >= *count) return;
    const uint path = active[index];
    Hit hit;
    intersect_closest(GEOMETRY_ARGUMENTS, rays[path], &hit);
    hits[path] = hit;
}
