// First step of listing connections: how many light vertices the camera vertices of each chunk connect to. Reads flags, the
// last vertex of each light subpath and the links; writes one count a chunk. One work-item a chunk of FLAG_CHUNK items.
// Used by the bidirectional methods.
#include "scene/own_light_path.h"
#include "shared/queue.h"

__kernel void count_connections(SamplerKey key, uint light_paths, __global const uint* restrict active,
                                __global const uint* restrict active_count, __global const uint* restrict flags,
                                __global const uint* restrict last_vertices, __global const VertexLink* restrict links, uint chunks,
                                __global uint* restrict counts)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint end = min((chunk + 1u) * FLAG_CHUNK, *active_count);
    uint count = 0u;
    for (uint item = chunk * FLAG_CHUNK; item < end; ++item) {
        if (!(flags[item] & PATH_JOINS)) continue;
        const uint last = last_vertices[own_light_path(key, active[item], light_paths)];
        count += last == NO_VERTEX ? 0u : links[last].rank;
    }
    counts[chunk] = count;
}
