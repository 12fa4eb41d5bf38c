// Scatter step of the photon sort where one digit holds the whole key: moves the photons themselves, whose
// targets, one a cell, stay in cache. Reads photons and their keys; writes them in cell order; advances the
// histogram as scatter_keys does. One work-item a chunk.
#include "density/key_chunk.h"
#include "shared/photon.h"

__kernel void scatter_photons(__global const Photon* restrict photons, __global const uint* restrict keys, __global const uint* restrict photon_count, uint chunks,
                              uint digits, __global uint* restrict histogram, __global Photon* restrict sorted)
{
    const uint chunk = get_global_id(0);
    if (chunk >= chunks) return;
    const uint n = *photon_count;
    const uint end = chunk_start(n, chunk + 1u, chunks);
    __global uint* places = histogram + (size_t)chunk * digits;
    __global const float* from = (__global const float*)photons;
    __global float* to = (__global float*)sorted;
    for (uint i = chunk_start(n, chunk, chunks); i < end; ++i) vstore8(vload8(i, from), places[keys[i]]++, to);
}
