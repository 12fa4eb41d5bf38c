// Radii by k nearest photons: each query's becomes the distance to the k-th of the photons that count for it, k being
// -D NEAREST, or `largest` where there are fewer within that. The photons nearer than it, k - 1, are what a gather then finds,
// whose sum over pi r_k^2 is right in the mean, which that of all k is not: with n photons a unit area pi r_k^2 n is
// gamma distributed with shape k, and the mean of its inverse 1 / (k - 1). Reads cell ends of a dense grid and photon streams;
// updates queries. One work-item a query; the ball it searches doubles its radius, from `first`, until it holds enough. Used
// by photonmapper.
#include "density/nearest_heap.h"
#include "density/photon_grid.h"
#include "density/wanted_photons.h"
#include "math/simd8.h"

// Keeps the squared distances of a run's photons that are below `limit`. Returns the limit for what follows.
static inline float keep_run(PhotonRun run, const GatherQuery* query, __global const float* streams, uint stride, float limit, NearestHeap* heap)
{
    const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
    const float3 position = unpack(query->position);
    for (uint i = run.begin; i < run.end; i += 8u) {
        const Offset8 offset = photon_offsets(streams, stride, i, position);
        const float8 squares = squared_lengths(offset);
        int8 mask = (squares < limit) & (lane < (int8)((int)(run.end - i)));
        if (!mask8(mask)) continue;
        mask &= wanted(as_uint8(load_stream(streams, PHOTON_NORMAL_DEPTH, stride, i)), query);
        float distance[8];
        vstore8(squares, 0, distance);
        for (int lanes = mask8(mask); lanes != 0; lanes &= lanes - 1) {
            const float square = distance[first_lane(lanes)];
            if (!(square < limit)) continue;
            keep_smaller(heap, square);
            if (heap->size == NEAREST) limit = heap->values[0];
        }
    }
    return limit;
}

__kernel void find_nearest_radii(PhotonGrid grid, __global const uint* restrict cell_ends, uint cell_ends_offset, __global const float* restrict streams,
                                 float first, float largest, uint count, __global GatherQuery* restrict queries)
{
    const uint index = get_global_id(0);
    if (index >= count || queries[index].radius == 0.0f) return;
    const GatherQuery query = queries[index];
    NearestHeap heap;
    for (float radius = fmin(first, largest);; radius = fmin(2.0f * radius, largest)) {
        heap.size = 0u;
        float limit = radius * radius;
        const CellRange range = cells_within(&grid, unpack(query.position), radius);
        for (uint z = range.z0; z <= range.z1; ++z)
            for (uint y = range.y0; y <= range.y1; ++y)
                limit = keep_run(row_run(&grid, cell_ends + cell_ends_offset, &range, y, z), &query, streams, grid.stride, limit, &heap);
        if (heap.size == NEAREST || radius >= largest) break;
    }
    // A little less, so that rounding does not bring the k-th photon in.
    queries[index].radius = heap.size == NEAREST ? sqrt(heap.values[0]) * (1.0f - 4e-7f) : largest;
}
