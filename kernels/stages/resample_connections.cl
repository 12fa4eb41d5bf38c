// Lists connections: each camera vertex with `picks` (1 to 4) light vertices chosen among those of all light subpaths
// [Davidovic et al. 2014, section 5.1]. Reads flags, each chunk's first place in units of picks, and the links, of which `slots` hold
// a vertex or none; writes each item's first place, and those pairs whose places lie in [window, window + capacity), with
// NO_VERTEX where the slot chosen holds none. One work-item a chunk of FLAG_CHUNK items. Used by the bidirectional methods.
#include "math/sampler.h"
#include "shared/bidirectional.h"
#include "shared/queue.h"

__kernel void resample_connections(SamplerKey key, uint picks, uint slots, __global const uint* restrict active,
                                   __global const uint* restrict active_count, __global const uint* restrict flags,
                                   __global const PathVertex* restrict camera_vertices, __global const VertexLink* restrict links,
                                   uint chunks, __global const uint* restrict starts, uint window, uint capacity,
                                   __global uint* restrict firsts, __global VertexPair* restrict pairs)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint end = min((chunk + 1u) * FLAG_CHUNK, *active_count);
    uint place = starts[chunk] * picks;
    for (uint item = chunk * FLAG_CHUNK; item < end; ++item) {
        firsts[item] = place;
        if (!(flags[item] & PATH_JOINS)) continue;
        const uint path = active[item];
        uint words[4];
        vstore4(camera_words(key, path, camera_vertices[path].depth, BLOCK_SPARE), 0, words);
        for (uint pick = 0u; pick < picks; ++pick, ++place) {
            const uint slot = mul_hi(words[pick], slots);
            const VertexPair pair = {path, links[slot].rank > 0u ? slot : NO_VERTEX};
            if (place - window < capacity) pairs[place - window] = pair;
        }
    }
    if (chunk == chunks - 1u) firsts[*active_count] = place;
}
