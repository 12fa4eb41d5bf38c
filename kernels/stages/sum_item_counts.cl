// Second step of listing what items have several of: sums of the counts of each chunk. Reads one count an item; writes one a chunk, at most
// 2^32 - 1. One
// work-item a chunk of FLAG_CHUNK items. Used by upg.
#include "shared/queue.h"

__kernel void sum_item_counts(__global const uint* restrict item_counts, __global const uint* restrict item_count, uint chunks,
                              __global uint* restrict chunk_counts)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint end = min((chunk + 1u) * FLAG_CHUNK, *item_count);
    uint count = 0u;
    for (uint item = chunk * FLAG_CHUNK; item < end; ++item) count = add_sat(count, item_counts[item]);
    chunk_counts[chunk] = count;
}
