// For each of some photons the nearest one of a map: of its side of the surface, of a direction close to its own, and like
// it marked as PHOTON_UNREACHED or not. Reads a dense grid whose photons have their index, its lower and its upper 16 bits, as
// the first two channels of their flux; writes the index, or NO_NEAREST_PHOTON beyond relaxation.largest_radius. One work-item a
// photon. Used by photonmapper.
#include "density/photon_lanes.h"
#include "density/wanted_photons.h"
#include "math/frame.h"
#include "shared/path.h"
#include "shared/relaxation.h"

typedef struct NearestPhoton {
    float3 position, direction;
    const Photon* photon;
    const GatherQuery* query;
    float least_cosine;
    float square; // of the distance; before one is found, that of the search's radius
    uint index;
} NearestPhoton;
#define VISITOR NearestPhoton

static inline int8 visitor_reach(const NearestPhoton* nearest, Offset8 offset, float8* squares)
{
    *squares = squared_lengths(offset);
    return *squares < nearest->square;
}

static inline NearestPhoton visit(NearestPhoton nearest, const PhotonMap* map, Photons8 photons)
{
    const uint8 normal_depth = as_uint8(load_stream(map, PHOTON_NORMAL_DEPTH, photons.first));
    int8 mask = photons.mask & wanted(normal_depth, nearest.query);
    mask &= as_int8((normal_depth & PHOTON_UNREACHED) == (uint8)(nearest.photon->normal_depth & PHOTON_UNREACHED));
    float square[8];
    vstore8(photons.squares, 0, square);
    for (int lanes = mask8(mask); lanes != 0; lanes &= lanes - 1) {
        const int lane = first_lane(lanes);
        const uint place = photons.first + (uint)lane;
        if (!(square[lane] < nearest.square)) continue;
        const uint packed = as_uint(stream_value(map, PHOTON_DIRECTION, place));
        if (nearest.least_cosine > -1.0f && dot(unpack_direction(packed), nearest.direction) < nearest.least_cosine) continue;
        nearest.square = square[lane];
        nearest.index = (uint)stream_value(map, PHOTON_RED, place) + ((uint)stream_value(map, PHOTON_GREEN, place) << 16);
    }
    return nearest;
}

#include "density/visit_photons.h"

__kernel void find_nearest_photons(MAP_PARAMETERS, Relaxation relaxation, __global const Photon* restrict photons, uint count,
                                   __global uint* restrict nearest_photons)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const PhotonMap map = MAP_VIEW;
    const Photon photon = photons[index];
    GatherQuery query;
    query.position = photon.position;
    query.normal = pack(photon_normal(photon.normal_depth));
    query.flags = 0u;
    query.max_photon_depth = UNBOUNDED_DEPTH;
    NearestPhoton nearest = {unpack(photon.position), unpack_direction(photon.direction), &photon, &query, relaxation.least_cosine,
                             0.0f, NO_NEAREST_PHOTON};
    for (float radius = fmin(relaxation.first_radius, relaxation.largest_radius);; radius = fmin(2.0f * radius, relaxation.largest_radius)) {
        nearest.square = radius * radius;
        nearest = visit_photons_within(nearest, &map, radius);
        if (nearest.index != NO_NEAREST_PHOTON || radius >= relaxation.largest_radius) break;
    }
    nearest_photons[index] = nearest.index;
}
