// Whether something blocks each active path's ray: 1 if so, 0 if it is free.
//
// Reads rays; writes occluded. A ray with t_max <= 0 is no ray and counts as
// blocked. One work-item an entry of `active`, the list of path indices, of
// which the first *count count. Rays and occluded are indexed by path. Used by
// every method that connects to lights or to the camera.
#include "scene/bvh_traverse.h"

__kernel void trace_any(GEOMETRY_PARAMETERS, __global const Ray* restrict rays, __global const uint* restrict active,
                        __global const uint* restrict count, __global uint* restrict occluded)
{
    const uint index = (uint)get_global_id(0);
    if (index >= *count) return;
    const uint path = active[index];
    const Ray ray = rays[path];
    occluded[path] = !(ray.t_max > 0.0f) || intersect_any(GEOMETRY_ARGUMENTS, ray) ? 1u : 0u;
}
