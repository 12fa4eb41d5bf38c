// One vertex of a camera path, with next-event estimation and BSDF sampling under multiple importance
// sampling. Reads hits of the active paths; adds emission to radiance; writes the light's shadow ray with
// what it would bring, the next ray, and whether the path goes on. One work-item an active path. -D REGULARIZED: specular vertices
// have light as well. Used by path, psr and pssmlt.
#include "scene/continue_path.h"
#include "scene/direct_light.h"
#include "scene/mollified_light.h"

__kernel void shade_camera_path(SURFACE_PARAMETERS, SAMPLER_PARAMETERS, PathRules rules, Regularization regularization, __global const Hit* restrict hits,
                                __global const uint* restrict active, __global const uint* restrict active_count, __global Ray* restrict rays,
                                __global PathState* restrict paths, __global Vec3* restrict radiance, __global Ray* restrict shadow_rays,
                                __global Vec3* restrict shadow_radiance, __global uint* restrict flags)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint index = active[item];
    const SurfaceView scene = SURFACE_VIEW;
    PathState path = paths[index];
    const float3 throughput = unpack(path.throughput);
    const Hit hit = hits[index];
    flags[item] = PATH_ENDED;
    shadow_rays[index].t_max = 0.0f;
    if (path.depth > rules.max_depth) return;

    if (hit.primitive == NO_PRIMITIVE) {
        radiance[index] = pack(unpack(radiance[index]) + throughput * found_environment(&scene, &path, rays[index], true));
        return;
    }
    const Ray ray = rays[index];
    const Surface surface = surface_at(&scene, ray, hit);
    const float3 emitted = found_emission(&scene, &surface, &path, ray, true);
    if (!is_black(emitted)) radiance[index] = pack(unpack(radiance[index]) + throughput * emitted);
    if (path.depth >= rules.max_depth) return;

    Sampler sampler = camera_sampler(SAMPLER_VIEW, index, path.depth);
    const uint4 words = next_words(&sampler);
    Scattering scattering = scattering_at(&scene, &surface, unit_float(words.w));
    disperse(camera_hero(&scene, key, index), &path, &scattering);
    if (!is_specular(&scattering) && !is_black_side(&scattering)) {
        Ray shadow_ray;
        shadow_radiance[index] = pack(throughput * sample_direct_light(&scene, &surface, &scattering, words, true, &shadow_ray));
        shadow_rays[index] = shadow_ray;
    } else if (REGULARIZED && path.scattered > 0u && is_specular(&scattering)) {
        const float4 u = unit_float4(camera_words(SAMPLER_VIEW, index, path.depth, BLOCK_SPARE));
        Ray shadow_ray;
        shadow_radiance[index] = pack(sample_mollified_light(&scene, &surface, &scattering, unpack(path.throughput), regularization, words, u, &shadow_ray));
        shadow_rays[index] = shadow_ray;
    }
    Ray next;
    if (!continue_camera_path(&surface, &scattering, rules, &sampler, &path, &next)) return;
    rays[index] = next;
    paths[index] = path;
    flags[item] = PATH_ALIVE;
}
