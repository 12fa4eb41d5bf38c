// For each of some photons the nearest one of a map: of its side of the surface, of a direction close to its own, and like
// it marked as PHOTON_UNREACHED or not. Reads a dense grid whose photons have their index, its lower and its upper 16 bits, as
// the first two channels of their flux; writes the index, or NO_NEAREST_PHOTON beyond relaxation.largest_radius. One work-item a
// photon. Used by photonmapper.
#include "density/photon_grid.h"
#include "density/wanted_photons.h"
#include "math/frame.h"
#include "math/simd8.h"
#include "shared/relaxation.h"

typedef struct NearestPhoton {
    float square; // of the distance; before one is found, that of the search's radius
    uint index;
} NearestPhoton;

static inline NearestPhoton nearest_of_run(PhotonRun run, const Photon* photon, const GatherQuery* query, float least_cosine,
                                           __global const float* streams, uint stride, NearestPhoton nearest)
{
    const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
    const float3 position = unpack(query->position), direction = unpack_direction(photon->direction);
    for (uint i = run.begin; i < run.end; i += 8u) {
        const Offset8 offset = photon_offsets(streams, stride, i, position);
        const float8 squares = squared_lengths(offset);
        int8 mask = (squares < nearest.square) & (lane < (int8)((int)(run.end - i)));
        if (!mask8(mask)) continue;
        const uint8 normal_depth = as_uint8(load_stream(streams, PHOTON_NORMAL_DEPTH, stride, i));
        mask &= wanted(normal_depth, query);
        mask &= as_int8((normal_depth & PHOTON_UNREACHED) == (uint8)(photon->normal_depth & PHOTON_UNREACHED));
        float square[8];
        vstore8(squares, 0, square);
        for (int lanes = mask8(mask); lanes != 0; lanes &= lanes - 1) {
            const uint place = i + (uint)first_lane(lanes);
            const float s = square[place - i];
            if (!(s < nearest.square)) continue;
            const uint packed = as_uint(streams[(size_t)PHOTON_DIRECTION * stride + place]);
            if (least_cosine > -1.0f && dot(unpack_direction(packed), direction) < least_cosine) continue;
            nearest.square = s;
            nearest.index = (uint)streams[(size_t)PHOTON_RED * stride + place] + ((uint)streams[(size_t)PHOTON_GREEN * stride + place] << 16);
        }
    }
    return nearest;
}

__kernel void find_nearest_photons(PhotonGrid grid, __global const uint* restrict cell_ends, uint cell_ends_offset,
                                   __global const float* restrict streams, Relaxation relaxation, __global const Photon* restrict photons,
                                   uint count, __global uint* restrict nearest_photons)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const Photon photon = photons[index];
    GatherQuery query;
    query.position = photon.position;
    query.normal = pack(unpack_normal(photon.normal_depth));
    query.flags = 0u;
    query.max_photon_depth = PHOTON_MAX_DEPTH;
    NearestPhoton nearest;
    for (float radius = fmin(relaxation.first_radius, relaxation.largest_radius);; radius = fmin(2.0f * radius, relaxation.largest_radius)) {
        nearest.square = radius * radius;
        nearest.index = NO_NEAREST_PHOTON;
        const CellRange range = cells_within(&grid, unpack(photon.position), radius);
        for (uint z = range.z0; z <= range.z1; ++z)
            for (uint y = range.y0; y <= range.y1; ++y)
                nearest = nearest_of_run(row_run(&grid, cell_ends + cell_ends_offset, &range, y, z), &photon, &query,
                                         relaxation.least_cosine, streams, grid.stride, nearest);
        if (nearest.index != NO_NEAREST_PHOTON || radius >= relaxation.largest_radius) break;
    }
    nearest_photons[index] = nearest.index;
}
