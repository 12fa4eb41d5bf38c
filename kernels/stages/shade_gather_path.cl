// One vertex of a gather ray's path: at the first lobe that is neither specular nor narrow it asks for photons and ends; through
// others it goes on. Emission that it meets does not count: where it started, light straight from its source and light
// focused by such lobes were found in other ways. Reads hits of the active paths; writes queries (radius 0: none), the next ray
// and whether the path goes on. One work-item an active path. Used by photonmapper.
#include "density/photon_query.h"
#include "scene/continue_path.h"

__kernel void shade_gather_path(SURFACE_PARAMETERS, SamplerKey key, PathRules rules, float radius,
                                __global const Hit* restrict hits, __global const uint* restrict active, __global const uint* restrict active_count,
                                __global Ray* restrict rays, __global PathState* restrict paths, __global GatherQuery* restrict queries,
                                __global LobeRecord* restrict query_lobes, __global uint* restrict flags)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint index = active[item];
    const Hit hit = hits[index];
    flags[item] = PATH_ENDED;
    if (hit.primitive == NO_PRIMITIVE) return;
    const SurfaceView scene = SURFACE_VIEW;
    PathState path = paths[index];
    const Surface surface = surface_at(&scene, rays[index], hit);
    Sampler sampler = camera_sampler(key, index, path.depth);
    Scattering scattering = scattering_at(&scene, &surface, unit_float(next_words(&sampler).w));
    disperse(camera_hero(&scene, key, index), &path, &scattering);
    if (is_black_side(&scattering)) return;
    if (!is_specular(&scattering) && !is_narrow(&scattering)) {
        const GatherQuery query = make_query(&surface, &scattering, unpack(path.throughput), edges_left(rules, &path), radius);
        if (query.flags & QUERY_EVALUATES_LOBE) pack_lobe(&scattering, &surface, query_lobes + index);
        queries[index] = query;
        return;
    }
    if (path.depth + 2u > rules.max_depth) return;
    Ray next;
    if (!continue_camera_path(&surface, &scattering, rules, &sampler, &path, &next)) return;
    rays[index] = next;
    paths[index] = path;
    flags[item] = PATH_ALIVE;
}
