// First step of listing light vertices near the hits of camera subpaths: how many there are. Reads the active paths, their rays and
// hits, the photon map and the slots in its order; writes one count an item. One work-item an active path. Used by upg.
#include "density/near_photons.h"

__kernel void count_near_photons(PhotonGrid grid, __global const uint* restrict cell_ends, uint cell_ends_offset,
                                 __global const float* restrict streams, __global const uint* restrict slots, float radius,
                                 __global const uint* restrict active, __global const uint* restrict active_count,
                                 __global const PathState* restrict paths, __global const Ray* restrict rays,
                                 __global const Hit* restrict hits, __global uint* restrict counts)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint path = active[item];
    const PathState state = paths[path];
    const Hit hit = hits[path];
    uint count = 0u;
    if (stands_in(&state, &hit)) {
        const float3 position = hit_position(rays[path], hit.t);
        PhotonRun runs[8];
        const uint run_count = find_photon_runs(&grid, cell_ends + cell_ends_offset, position, runs);
        for (uint r = 0u; r < run_count; ++r)
            for (uint i = runs[r].begin; i < runs[r].end; i += 8u)
                count += popcount((uint)near_lanes(streams, slots, grid.stride, runs[r], i, position, radius));
    }
    counts[item] = count;
}
