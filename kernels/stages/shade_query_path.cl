// One vertex of a camera path that looks for photons. Through specular surfaces the path goes on; at the
// first other one it leaves a query and, with next-event estimation (-D DIRECT_LIGHT=1), a shadow ray. Through
// narrow lobes it goes on as well, since hardly a photon arrives from where they look; what a path that goes on can
// never find, light from points and directions by way of specular surfaces, it asks for there with probability
// `narrow_query_share`. Emission met on the way is added to radiance: nothing else finds it. One work-item an
// active path. Used by pppm and sppm.
#include "density/photon_query.h"
#include "scene/continue_path.h"
#include "scene/direct_light.h"

// With which probability a narrow lobe's path took the way it takes; 1 where it has no choice.
typedef struct Continuation {
    bool asks;
    float probability;
} Continuation;

static inline Continuation choose_continuation(const Scattering* scattering, float narrow_query_share, Sampler* sampler)
{
    Continuation continuation = {!is_specular(scattering), 1.0f};
    if (!is_narrow(scattering)) return continuation;
    continuation.asks = next_4d(sampler).x < narrow_query_share;
    continuation.probability = continuation.asks ? narrow_query_share : 1.0f - narrow_query_share;
    return continuation;
}

__kernel void shade_query_path(SURFACE_PARAMETERS, SamplerKey key, PathRules rules, float radius,
                               float narrow_query_share, __global const Hit* restrict hits,
                               __global const uint* restrict active, __global const uint* restrict active_count, __global Ray* restrict rays,
                               __global PathState* restrict paths, __global Vec3* restrict radiance, __global Ray* restrict shadow_rays,
                               __global Vec3* restrict shadow_radiance, __global GatherQuery* restrict queries, __global LobeRecord* restrict query_lobes,
                               __global uint* restrict flags)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint index = active[item];
    const SurfaceView scene = SURFACE_VIEW;
    PathState path = paths[index];
    const float3 throughput = unpack(path.throughput);
    const Hit hit = hits[index];
    flags[item] = PATH_ENDED;
#if DIRECT_LIGHT
    shadow_rays[index].t_max = 0.0f;
#endif
    queries[index].radius = 0.0f;
    if (path.depth > rules.max_depth) return;

    const bool mis = DIRECT_LIGHT && LOBES_MAY_BE_NARROW;
    if (hit.primitive == NO_PRIMITIVE) {
        radiance[index] = pack(unpack(radiance[index]) + throughput * found_environment(&scene, &path, rays[index], mis));
        return;
    }
    const Ray ray = rays[index];
    const Surface surface = surface_at(&scene, ray, hit);
    const float3 emitted = found_emission(&scene, &surface, &path, ray, mis);
    if (!is_black(emitted)) radiance[index] = pack(unpack(radiance[index]) + throughput * emitted);
    if (path.depth >= rules.max_depth) return;

    Sampler sampler = camera_sampler(key, index, path.depth);
    const uint4 words = next_words(&sampler);
    Scattering scattering = scattering_at(&scene, &surface, unit_float(words.w));
    disperse(camera_hero(&scene, key, index), &path, &scattering);
    if (is_black_side(&scattering)) return;
#if DIRECT_LIGHT
    if (!is_specular(&scattering)) {
        Ray shadow_ray;
        shadow_radiance[index] = pack(throughput * sample_direct_light(&scene, &surface, &scattering, words, is_narrow(&scattering), &shadow_ray));
        shadow_rays[index] = shadow_ray;
    }
#endif
    const Continuation continuation = choose_continuation(&scattering, narrow_query_share, &sampler);
    if (continuation.asks) {
        const GatherQuery query = make_query(&surface, &scattering, throughput / continuation.probability, edges_left(rules, &path), radius);
        if (query.flags & QUERY_EVALUATES_LOBE) pack_lobe(&scattering, &surface, query_lobes + index);
        queries[index] = query;
        return;
    }
    path.throughput = pack(throughput / continuation.probability);
    Ray next;
    if (!continue_camera_path(&surface, &scattering, rules, &sampler, &path, &next)) return;
    rays[index] = next;
    paths[index] = path;
    flags[item] = PATH_ALIVE;
}
