// Scatter step of the stable key sort: moves each key's index (and, when another digit follows, the key) to
// its place. Reads keys and the order so far (-D FIRST_DIGIT=1: the identity); advances the histogram, whose
// entries end at their digits' ends. One work-item a chunk.
#include "density/key_chunk.h"

__kernel void scatter_keys(__global const uint* restrict keys, __global const uint* restrict order, __global const uint* restrict key_count, uint chunks,
                           uint shift, uint digits, __global uint* restrict histogram, __global uint* restrict sorted_keys, __global uint* restrict sorted_order)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint n = *key_count;
    const uint end = chunk_start(n, chunk + 1u, chunks);
    __global uint* places = histogram + (size_t)chunk * digits;
    for (uint i = chunk_start(n, chunk, chunks); i < end; ++i) {
        const uint key = keys[i];
        const uint place = places[(key >> shift) & (digits - 1u)]++;
#if KEEP_KEYS
        sorted_keys[place] = key;
#endif
#if FIRST_DIGIT
        sorted_order[place] = i;
#else
        sorted_order[place] = order[i];
#endif
    }
}
