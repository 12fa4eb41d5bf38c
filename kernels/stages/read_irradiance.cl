// Answers queries at diffuse lobes by the irradiance of the nearest place where it was computed, within the radius and with a
// normal close to the query's [Christensen 1999, section 3]. Reads a grid whose "photons" hold irradiance (W/m^2) as their flux;
// adds to radiance, and takes the radius from the queries that it has answered. One work-item a query. Used by photonmapper.
#include "density/photon_lanes.h"
#include "density/wanted_photons.h"

#define LEAST_COSINE 0.9f
#define NO_PLACE 0xffffffffu

typedef struct NearestPlace {
    float3 position, normal; // of the query
    float square;            // of the distance
    uint index;
} NearestPlace;
#define VISITOR NearestPlace

static inline int8 visitor_reach(const NearestPlace* nearest, Offset8 offset, float8* squares)
{
    *squares = squared_lengths(offset);
    return *squares < nearest->square;
}

static inline NearestPlace visit(NearestPlace nearest, const PhotonMap* map, Photons8 places)
{
    const uint8 normals = as_uint8(load_stream(map, PHOTON_NORMAL_DEPTH, places.first));
    const int8 mask = places.mask & on_same_side(normals, nearest.normal, false, LEAST_COSINE);
    float square[8];
    vstore8(places.squares, 0, square);
    for (int lanes = mask8(mask); lanes != 0; lanes &= lanes - 1) {
        const uint lane = (uint)first_lane(lanes);
        if (!(square[lane] < nearest.square)) continue;
        nearest.square = square[lane];
        nearest.index = places.first + lane;
    }
    return nearest;
}

#include "density/visit_photons.h"

__kernel void read_irradiance(MAP_PARAMETERS, float radius, uint count, __global GatherQuery* restrict queries, __global Vec3* restrict radiance)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const GatherQuery query = queries[index];
    if (query.radius == 0.0f || (query.flags & QUERY_EVALUATES_LOBE)) return;
    const PhotonMap map = MAP_VIEW;
    NearestPlace nearest = {unpack(query.position), unpack(query.normal), radius * radius, NO_PLACE};
    nearest = visit_photons(nearest, &map);
    if (nearest.index == NO_PLACE) return;
    const float3 irradiance = (float3)(stream_value(&map, PHOTON_RED, nearest.index), stream_value(&map, PHOTON_GREEN, nearest.index),
                                       stream_value(&map, PHOTON_BLUE, nearest.index));
    radiance[index] = pack(unpack(radiance[index]) + unpack(query.throughput) * irradiance);
    queries[index].radius = 0.0f;
}
