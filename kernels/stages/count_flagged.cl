// First step of compaction: how many flags of each chunk have a bit of `mask`. Reads flags; writes one count
// a chunk. One work-item a chunk of FLAG_CHUNK items.
#include "shared/queue.h"

__kernel void count_flagged(__global const uint* restrict flags, __global const uint* restrict item_count, uint mask, uint chunks, __global uint* restrict counts)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint end = min((chunk + 1u) * FLAG_CHUNK, *item_count);
    uint count = 0u;
    for (uint item = chunk * FLAG_CHUNK; item < end; ++item) count += (flags[item] & mask) != 0u ? 1u : 0u;
    counts[chunk] = count;
}
