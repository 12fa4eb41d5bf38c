// Lays the slots of the light vertices that photons lie on out in the order of the photon map. Reads the vertices, by photon, and
// the order; writes slots. One work-item a photon. Used by upg.
#include "shared/bidirectional.h"

__kernel void order_slots(__global const PhotonVertex* restrict vertices, __global const uint* restrict order,
                          __global const uint* restrict photon_count, __global uint* restrict slots)
{
    const uint place = get_global_id(0);
    if (place >= *photon_count) return;
    slots[place] = vertices[order[place]].slot;
}
