// Last step of listing connections: each camera vertex with every vertex of the light subpath that is its own
// [Veach and Guibas 1995; Lafortune and Willems 1993]. Reads flags, each chunk's first place, the last vertex of each light
// subpath and the links; writes each item's first place, and those pairs whose places lie in [window, window + capacity).
// One work-item a chunk of FLAG_CHUNK items. Used by the bidirectional methods.
#include "scene/own_light_path.h"
#include "shared/queue.h"

__kernel void list_connections(SamplerKey key, uint light_paths, __global const uint* restrict active,
                               __global const uint* restrict active_count, __global const uint* restrict flags,
                               __global const uint* restrict last_vertices, __global const VertexLink* restrict links, uint chunks,
                               __global const uint* restrict starts, uint window, uint capacity, __global uint* restrict firsts,
                               __global VertexPair* restrict pairs)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint end = min((chunk + 1u) * FLAG_CHUNK, *active_count);
    uint place = starts[chunk];
    for (uint item = chunk * FLAG_CHUNK; item < end; ++item) {
        firsts[item] = place;
        if (!(flags[item] & PATH_JOINS)) continue;
        const uint path = active[item];
        for (uint slot = last_vertices[own_light_path(key, path, light_paths)]; slot != NO_VERTEX; slot = links[slot].previous) {
            if (place - window < capacity) { // unsigned: also below the window
                const VertexPair pair = {path, slot};
                pairs[place - window] = pair;
            }
            ++place;
        }
    }
    if (chunk == chunks - 1u) firsts[*active_count] = place;
}
