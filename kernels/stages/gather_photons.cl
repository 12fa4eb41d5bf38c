// Asks the photon map: for each query, the estimator's sum over the photons within its radius that lie on its
// side of the surface and do not make the path too long. Reads queries, cell ends and photon streams; writes
// sums (zero where there is no query). One work-item a query; eight photons at a time. The estimator
// (kernels/estimators) is the program's prelude. -D WIDE_QUERIES=1: radii may exceed the one that the grid was built for,
// which is dense. Used by the photon mapping methods.
#include "density/photon_lanes.h"
#include "density/wanted_photons.h"
#include "shared/bsdf.h"
// -D GATHERS_LOBES=1 where queries may come from lobes other than diffuse ones.
#if GATHERS_LOBES
#include "scene/bsdf.h"
#endif

#if GATHERS_LOBES
// Flux times f of the photons in the mask, one after another; zero for the others.
static inline Flux8 scattered_flux(Flux8 flux, uint8 directions, int8 mask, __global const LobeRecord* record)
{
    float red[8], green[8], blue[8];
    uint direction[8];
    int lane_mask[8];
    vstore8(flux.red, 0, red);
    vstore8(flux.green, 0, green);
    vstore8(flux.blue, 0, blue);
    vstore8(directions, 0, direction);
    vstore8(mask, 0, lane_mask);
    Surface surface;
    const Scattering scattering = unpack_lobe(record, &surface);
    for (int i = 0; i < 8; ++i) {
        const float3 f = lane_mask[i] ? evaluate_for_photon(&scattering, &surface, -unpack_direction(direction[i])) : (float3)(0.0f);
        red[i] = lane_mask[i] ? red[i] * f.x : 0.0f;
        green[i] = lane_mask[i] ? green[i] * f.y : 0.0f;
        blue[i] = lane_mask[i] ? blue[i] * f.z : 0.0f;
    }
    const Flux8 scattered = {vload8(0, red), vload8(0, green), vload8(0, blue)};
    return scattered;
}
#endif

typedef struct Gathering {
    float3 position;
    float inverse_radius_squared;
    const GatherQuery* query;
    __global const LobeRecord* lobe;
    Estimate estimate;
} Gathering;
#define VISITOR Gathering

// Squares are shares of the radius'.
static inline int8 visitor_reach(const Gathering* gathering, Offset8 offset, float8* squares)
{
    *squares = squared_lengths(offset) * gathering->inverse_radius_squared;
    return *squares < 1.0f;
}

static inline Gathering visit(Gathering gathering, const PhotonMap* map, Photons8 photons)
{
    const int8 mask = photons.mask & wanted(as_uint8(load_stream(map, PHOTON_NORMAL_DEPTH, photons.first)), gathering.query);
    Flux8 flux = load_flux(map, photons.first);
#if GATHERS_LOBES
    if (gathering.query->flags & QUERY_EVALUATES_LOBE)
        flux = scattered_flux(flux, as_uint8(load_stream(map, PHOTON_DIRECTION, photons.first)), mask, gathering.lobe);
#endif
    estimator_add(&gathering.estimate, mask, photons.offset, photons.squares, flux.red, flux.green, flux.blue);
    return gathering;
}

#include "density/visit_photons.h"

__kernel void gather_photons(MAP_PARAMETERS, __global const GatherQuery* restrict queries, __global const LobeRecord* restrict query_lobes, uint count,
                             __global ESTIMATOR_RESULT* restrict sums)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const GatherQuery query = queries[index];
    ESTIMATOR_RESULT sum = {{0.0f}};
    if (query.radius > 0.0f) {
        const PhotonMap map = MAP_VIEW;
        Gathering gathering = {unpack(query.position), 1.0f / (query.radius * query.radius), &query, query_lobes + index};
        estimator_begin(&gathering.estimate, &query);
#if WIDE_QUERIES
        gathering = visit_photons_within(gathering, &map, query.radius);
#else
        gathering = visit_photons(gathering, &map);
#endif
        sum = estimator_end(&gathering.estimate, query.radius);
    }
    sums[index] = sum;
}
