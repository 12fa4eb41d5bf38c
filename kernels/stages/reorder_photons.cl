// Lays photons out in cell order, as structure of arrays. Reads photons and their order; writes the streams.
// One work-item a photon.
#include "shared/photon.h"

__kernel void reorder_photons(__global const Photon* restrict photons, __global const uint* restrict order, __global const uint* restrict photon_count, uint stride,
                              __global float* restrict streams)
{
    const uint i = get_global_id(0);
    if (i >= *photon_count) return;
    const Photon photon = photons[order[i]];
    streams[PHOTON_X * stride + i] = photon.position.x;
    streams[PHOTON_Y * stride + i] = photon.position.y;
    streams[PHOTON_Z * stride + i] = photon.position.z;
    streams[PHOTON_RED * stride + i] = photon.flux.x;
    streams[PHOTON_GREEN * stride + i] = photon.flux.y;
    streams[PHOTON_BLUE * stride + i] = photon.flux.z;
    streams[PHOTON_DIRECTION * stride + i] = as_float(photon.direction);
    streams[PHOTON_NORMAL_DEPTH * stride + i] = as_float(photon.normal_depth);
}
