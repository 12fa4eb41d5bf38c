// The photon map as kernel parameters and as one value that functions take; eight of its photons at a time.
#ifndef SUNDOG_PHOTON_LANES_H
#define SUNDOG_PHOTON_LANES_H
#include "density/flux8.h"
#include "density/photon_grid.h"
#include "math/simd8.h"

// What PhotonMap of src/stages binds.
#define MAP_PARAMETERS                                                                                                                     \
    PhotonGrid grid, __global const uint *restrict cell_ends, uint cell_ends_offset, __global const float *restrict streams

typedef struct PhotonMap {
    PhotonGrid grid;
    __global const uint* cell_ends;
    __global const float* streams;
} PhotonMap;

// A PhotonMap of the kernel's MAP_PARAMETERS.
#define MAP_VIEW {grid, cell_ends + cell_ends_offset, streams}

// Eight photons that follow one another in the map.
typedef struct Photons8 {
    uint first;
    int8 mask; // those that count
    Offset8 offset; // from the position that asks
    float8 squares; // of their distances, as the visitor measures them
} Photons8;

static inline float8 load_stream(const PhotonMap* map, uint stream, uint i) { return vload8(0, map->streams + (size_t)stream * map->grid.stride + i); }

static inline float stream_value(const PhotonMap* map, uint stream, uint i) { return map->streams[(size_t)stream * map->grid.stride + i]; }

static inline Flux8 load_flux(const PhotonMap* map, uint i)
{
    const Flux8 flux = {load_stream(map, PHOTON_RED, i), load_stream(map, PHOTON_GREEN, i), load_stream(map, PHOTON_BLUE, i)};
    return flux;
}

// From a position to eight photons.
static inline Offset8 photon_offsets(const PhotonMap* map, uint i, float3 position)
{
    const Offset8 offset = {load_stream(map, PHOTON_X, i) - position.x, load_stream(map, PHOTON_Y, i) - position.y,
                            load_stream(map, PHOTON_Z, i) - position.z};
    return offset;
}

static inline float8 squared_lengths(Offset8 offset) { return offset.x * offset.x + offset.y * offset.y + offset.z * offset.z; }

#endif
