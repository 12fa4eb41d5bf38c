// Last step of compaction: the entries of a list whose flag has a bit of `mask`, in order. Reads list, flags
// and each chunk's start; writes the shorter list. One work-item a chunk.
#include "shared/queue.h"

__kernel void write_flagged(__global const uint* restrict list, __global const uint* restrict flags, __global const uint* restrict item_count, uint mask,
                            uint chunks, __global const uint* restrict starts, __global uint* restrict shorter)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint end = min((chunk + 1u) * FLAG_CHUNK, *item_count);
    uint target = starts[chunk];
    for (uint item = chunk * FLAG_CHUNK; item < end; ++item)
        if (flags[item] & mask) shorter[target++] = list[item];
}
