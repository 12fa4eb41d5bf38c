// Histogram step of the stable key sort: how many keys of each chunk have each digit. Reads keys; writes
// histogram[chunk * digits + digit]. One work-item a chunk: no atomics, the same order always.
#include "density/key_chunk.h"

__kernel void count_keys(__global const uint* restrict keys, __global const uint* restrict key_count, uint chunks, uint shift, uint digits,
                         __global uint* restrict histogram)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint n = *key_count;
    const uint end = chunk_start(n, chunk + 1u, chunks);
    __global uint* counts = histogram + (size_t)chunk * digits;
    for (uint digit = 0u; digit < digits; ++digit) counts[digit] = 0u;
    for (uint i = chunk_start(n, chunk, chunks); i < end; ++i) ++counts[(keys[i] >> shift) & (digits - 1u)];
}
