// Lays what photons bring for the weights of merges out in the order of the photon map, as structure of arrays: vcm, then vm.
// Reads the vertices, by photon, and the order; writes the streams. One work-item a photon. Used by the bidirectional methods.
#include "shared/bidirectional.h"

__kernel void reorder_merge_weights(__global const PhotonVertex* restrict vertices, __global const uint* restrict order,
                                    __global const uint* restrict photon_count, uint stride, __global float* restrict streams)
{
    const uint place = get_global_id(0);
    if (place >= *photon_count) return;
    const PhotonVertex vertex = vertices[order[place]];
    streams[place] = vertex.vcm;
    streams[stride + place] = vertex.vm;
}
