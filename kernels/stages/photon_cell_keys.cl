// Each photon's cell. Reads photons; writes keys to sort them by. One work-item a photon.
#include "density/photon_grid.h"

__kernel void photon_cell_keys(PhotonGrid grid, __global const Photon* restrict photons, __global const uint* restrict photon_count, __global uint* restrict keys)
{
    const uint i = get_global_id(0);
    if (i >= *photon_count) return;
    keys[i] = cell_of_photon(&grid, unpack(photons[i].position));
}
