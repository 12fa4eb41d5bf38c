// Appends the records that paths left to a list, in order. Reads deposits, flags and each chunk's place in
// the list; writes records below `capacity` (the host sees from the count when there were more). One
// work-item a chunk. RECORD is the record's type (-D RECORD=Photon): photons and splats alike.
#include "shared/bidirectional.h"
#include "shared/film.h"
#include "shared/path.h"
#include "shared/photon.h"
#include "shared/queue.h"

__kernel void append_records(__global const RECORD* restrict deposits, __global const uint* restrict flags, __global const uint* restrict item_count, uint chunks,
                             __global const uint* restrict starts, uint capacity, __global RECORD* restrict records)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint end = min((chunk + 1u) * FLAG_CHUNK, *item_count);
    uint target = starts[chunk];
    for (uint item = chunk * FLAG_CHUNK; item < end; ++item) {
        if (!(flags[item] & PATH_DEPOSIT)) continue;
        if (target < capacity) records[target] = deposits[item];
        ++target;
    }
}
