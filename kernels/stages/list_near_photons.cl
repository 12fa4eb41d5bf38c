// Last step of listing light vertices near the hits of camera subpaths: each path's last vertex with the vertices near its hit,
// which it is to be connected to in the hit's place [Qin et al. 2015, section 4]. Reads what count_near_photons reads, and each item's
// first place; writes those pairs whose places lie in [window, window + capacity). One work-item an active path. Used by upg.
#include "density/near_photons.h"

__kernel void list_near_photons(PhotonGrid grid, __global const uint* restrict cell_ends, uint cell_ends_offset,
                                __global const float* restrict streams, __global const uint* restrict slots, float radius,
                                __global const uint* restrict active, __global const uint* restrict active_count,
                                __global const Ray* restrict rays, __global const Hit* restrict hits, __global const uint* restrict firsts,
                                uint window, uint capacity, __global VertexPair* restrict pairs)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint end = firsts[item + 1u];
    uint place = firsts[item];
    if (place == end || place >= window + capacity || end <= window) return;
    const uint path = active[item];
    const float3 position = hit_position(rays[path], hits[path].t);
    PhotonRun runs[8];
    const uint run_count = find_photon_runs(&grid, cell_ends + cell_ends_offset, position, runs);
    for (uint r = 0u; r < run_count; ++r) {
        for (uint i = runs[r].begin; i < runs[r].end; i += 8u) {
            int lanes = near_lanes(streams, slots, grid.stride, runs[r], i, position, radius);
            for (; lanes != 0 && place < end; lanes &= lanes - 1, ++place) {
                const VertexPair pair = {path, slots[i + (uint)first_lane(lanes)]};
                if (place - window < capacity) pairs[place - window] = pair; // unsigned: also below the window
            }
        }
    }
}
