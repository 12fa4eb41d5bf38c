// Radii by k nearest photons: each query's becomes the distance to the k-th of the photons that count for it, k being
// -D NEAREST, or `largest` where there are fewer within that. The photons nearer than it, k - 1, are what a gather then finds,
// whose sum over pi r_k^2 is right in the mean, which that of all k is not: with n photons a unit area pi r_k^2 n is
// gamma distributed with shape k, and the mean of its inverse 1 / (k - 1). Reads cell ends of a dense grid and photon streams;
// updates queries. One work-item a query; the ball it searches doubles its radius, from `first`, until it holds enough. Used
// by photonmapper.
#include "density/nearest_heap.h"
#include "density/photon_lanes.h"
#include "density/wanted_photons.h"

// Keeps the squared distances below `limit`, which shrinks once there are enough.
typedef struct NearestDistances {
    float3 position;
    float limit;
    const GatherQuery* query;
    NearestHeap* heap;
} NearestDistances;
#define VISITOR NearestDistances

static inline int8 visitor_reach(const NearestDistances* nearest, Offset8 offset, float8* squares)
{
    *squares = squared_lengths(offset);
    return *squares < nearest->limit;
}

static inline NearestDistances visit(NearestDistances nearest, const PhotonMap* map, Photons8 photons)
{
    const int8 mask = photons.mask & wanted(as_uint8(load_stream(map, PHOTON_NORMAL_DEPTH, photons.first)), nearest.query);
    float distance[8];
    vstore8(photons.squares, 0, distance);
    for (int lanes = mask8(mask); lanes != 0; lanes &= lanes - 1) {
        const float square = distance[first_lane(lanes)];
        if (!(square < nearest.limit)) continue;
        keep_smaller(nearest.heap, square);
        if (nearest.heap->size == NEAREST) nearest.limit = nearest.heap->values[0];
    }
    return nearest;
}

#include "density/visit_photons.h"

__kernel void find_nearest_radii(MAP_PARAMETERS, float first, float largest, uint count, __global GatherQuery* restrict queries)
{
    const uint index = get_global_id(0);
    if (index >= count || queries[index].radius == 0.0f) return;
    const GatherQuery query = queries[index];
    const PhotonMap map = MAP_VIEW;
    NearestHeap heap;
    for (float radius = fmin(first, largest);; radius = fmin(2.0f * radius, largest)) {
        heap.size = 0u;
        const NearestDistances none = {unpack(query.position), radius * radius, &query, &heap};
        visit_photons_within(none, &map, radius);
        if (heap.size == NEAREST || radius >= largest) break;
    }
    // A little less, so that rounding does not bring the k-th photon in.
    queries[index].radius = heap.size == NEAREST ? sqrt(heap.values[0]) * (1.0f - 4e-7f) : largest;
}
