// What a camera path asks the photon map for.
#ifndef SUNDOG_PHOTON_QUERY_H
#define SUNDOG_PHOTON_QUERY_H
#include "scene/bsdf.h"
#include "shared/path.h"
#include "shared/photon.h"

// Edges that a photon may have for the whole path to be within the bound.
static inline uint edges_left(PathRules rules, const PathState* path)
{
    return rules.max_depth == UNBOUNDED_DEPTH ? UNBOUNDED_DEPTH : rules.max_depth - path->depth;
}

// A query at the lobe that the path has met; where it says so, with the lobe's record beside it.
static inline GatherQuery make_query(const Surface* surface, const Scattering* scattering, float3 throughput, uint max_photon_depth, float radius)
{
    GatherQuery query;
    query.position = pack(surface->position);
    query.radius = radius;
    query.flags = 0u;
    if (scattering->lobe == LOBE_DIFFUSE && !(scattering->flags & LOBE_CHANGED)) throughput *= evaluate_diffuse(scattering);
    else query.flags |= QUERY_EVALUATES_LOBE;
    if (is_transmissive(scattering)) query.flags |= QUERY_BOTH_SIDES;
    if (is_narrow(scattering)) query.flags |= QUERY_UNREACHED_ONLY;
    query.throughput = pack(throughput);
    query.max_photon_depth = max_photon_depth;
    query.normal = pack(facing(surface->geometric_normal, surface->outgoing));
    return query;
}

#endif
