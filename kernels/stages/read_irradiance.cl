// Answers queries at diffuse lobes by the irradiance of the nearest place where it was computed, within the radius and with a
// normal close to the query's [Christensen 1999, section 3]. Reads a grid whose "photons" hold irradiance (W/m^2) as their flux;
// adds to radiance, and takes the radius from the queries that it has answered. One work-item a query. Used by photonmapper.
#include "density/photon_grid.h"
#include "density/wanted_photons.h"
#include "math/simd8.h"

#define LEAST_COSINE 0.9f
#define NO_PLACE 0xffffffffu

typedef struct NearestPlace {
    float square; // of the distance
    uint index;
} NearestPlace;

static inline NearestPlace nearest_of_run(PhotonRun run, const GatherQuery* query, __global const float* streams, uint stride, NearestPlace nearest)
{
    const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
    const float3 position = unpack(query->position);
    for (uint i = run.begin; i < run.end; i += 8u) {
        const Offset8 offset = photon_offsets(streams, stride, i, position);
        const float8 squares = squared_lengths(offset);
        int8 mask = (squares < nearest.square) & (lane < (int8)((int)(run.end - i)));
        if (!mask8(mask)) continue;
        mask &= on_same_side(as_uint8(load_stream(streams, PHOTON_NORMAL_DEPTH, stride, i)), unpack(query->normal), false, LEAST_COSINE);
        float square[8];
        vstore8(squares, 0, square);
        for (int lanes = mask8(mask); lanes != 0; lanes &= lanes - 1) {
            const uint l = (uint)first_lane(lanes);
            if (!(square[l] < nearest.square)) continue;
            nearest.square = square[l];
            nearest.index = i + l;
        }
    }
    return nearest;
}

__kernel void read_irradiance(PhotonGrid grid, __global const uint* restrict cell_ends, uint cell_ends_offset, __global const float* restrict streams,
                              float radius, uint count, __global GatherQuery* restrict queries, __global Vec3* restrict radiance)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const GatherQuery query = queries[index];
    if (query.radius == 0.0f || (query.flags & QUERY_EVALUATES_LOBE)) return;
    PhotonRun runs[8];
    const uint run_count = find_photon_runs(&grid, cell_ends + cell_ends_offset, unpack(query.position), runs);
    NearestPlace nearest = {radius * radius, NO_PLACE};
    for (uint i = 0u; i < run_count; ++i) nearest = nearest_of_run(runs[i], &query, streams, grid.stride, nearest);
    if (nearest.index == NO_PLACE) return;
    const float3 irradiance = (float3)(streams[(size_t)PHOTON_RED * grid.stride + nearest.index],
                                       streams[(size_t)PHOTON_GREEN * grid.stride + nearest.index],
                                       streams[(size_t)PHOTON_BLUE * grid.stride + nearest.index]);
    radiance[index] = pack(unpack(radiance[index]) + unpack(query.throughput) * irradiance);
    queries[index].radius = 0.0f;
}
