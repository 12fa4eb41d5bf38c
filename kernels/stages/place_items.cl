// Third step of listing what items have several of: each item's first place. Reads one count an item and the chunks' first places;
// writes places, and the end after the last. One work-item a chunk of FLAG_CHUNK items. Used by upg.
#include "shared/queue.h"

__kernel void place_items(__global const uint* restrict item_counts, __global const uint* restrict item_count, uint chunks,
                          __global const uint* restrict starts, __global uint* restrict firsts)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint end = min((chunk + 1u) * FLAG_CHUNK, *item_count);
    uint place = starts[chunk];
    for (uint item = chunk * FLAG_CHUNK; item < end; ++item) {
        firsts[item] = place;
        place += item_counts[item];
    }
    if (chunk == chunks - 1u) firsts[end] = place;
}
