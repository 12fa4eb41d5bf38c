// Moves the marked splats to the front of another list, in order, and numbers each one's sample as renumber_samples does. Reads
// splats, samples, flags and each chunk's place; writes kept_splats and kept_samples. One work-item a chunk of FLAG_CHUNK splats. Used by pssmlt.
#include "shared/film.h"
#include "shared/path.h"
#include "shared/queue.h"

__kernel void keep_splats(__global const Splat* restrict splats, __global const uint* restrict samples, __global const uint* restrict flags,
                          uint count, uint chunks, __global const uint* restrict starts, uint chain_count, __global Splat* restrict kept_splats,
                          __global uint* restrict kept_samples)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint end = min((chunk + 1u) * FLAG_CHUNK, count);
    uint target = starts[chunk];
    for (uint i = chunk * FLAG_CHUNK; i < end; ++i) {
        if (!(flags[i] & PATH_DEPOSIT)) continue;
        kept_splats[target] = splats[i];
        kept_samples[target] = samples[i] % chain_count;
        ++target;
    }
}
