// One vertex of a camera path that looks for photons. Through specular surfaces the path goes on; at the
// first other one it leaves a query and, with next-event estimation (-D DIRECT_LIGHT=1), a shadow ray.
// Emission met on the way is added to radiance: nothing else finds it. One work-item an active path. Used by
// pppm and sppm.
#include "scene/camera_rays.h"
#include "scene/continue_path.h"
#include "scene/direct_light.h"
#include "shared/photon.h"

static inline GatherQuery make_query(const Surface* surface, const Scattering* scattering, const PathState* path, PathRules rules, uint pixel, float radius)
{
    GatherQuery query;
    query.position = pack(surface->position);
    query.radius = radius;
    query.throughput = pack(unpack(path->throughput) * unpack(scattering->bsdf.reflectance) * INV_PI_F);
    query.max_photon_depth = rules.max_depth == UNBOUNDED_DEPTH ? UNBOUNDED_DEPTH : rules.max_depth - path->depth;
    query.normal = pack(facing(surface->geometric_normal, surface->outgoing));
    query.pixel = pixel;
    return query;
}

__kernel void shade_query_path(SURFACE_PARAMETERS, SamplerKey key, PathRules rules, uint width, uint height, float radius, __global const Hit* restrict hits,
                               __global const uint* restrict active, __global const uint* restrict active_count, __global Ray* restrict rays,
                               __global PathState* restrict paths, __global Vec3* restrict radiance, __global Ray* restrict shadow_rays,
                               __global Vec3* restrict shadow_radiance, __global GatherQuery* restrict queries, __global uint* restrict flags)
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
    queries[index].radius = 0.0f;
    if (path.depth > rules.max_depth) return;

    if (hit.primitive == NO_PRIMITIVE) {
        const uint light = scene.globals->constant_light;
        if (light != NO_LIGHT) radiance[index] = pack(unpack(radiance[index]) + throughput * unpack(scene.lights[light].emission));
        return;
    }
    const Surface surface = surface_at(&scene, rays[index], hit);
    const float3 emitted = emitted_radiance(&scene, &surface, light_of_hit(&scene, &surface));
    if (!is_black(emitted)) radiance[index] = pack(unpack(radiance[index]) + throughput * emitted);
    if (path.depth >= rules.max_depth) return;

    const Scattering scattering = scattering_at(&scene, &surface);
    if (is_black_side(&scattering)) return;
    const uint2 pixel = pixel_of_path(index, width, height);
    Sampler sampler = camera_sampler(key, pixel.y * width + pixel.x, path.depth);
    const float4 u = next_4d(&sampler);
    if (!is_specular(&scattering)) {
        queries[index] = make_query(&surface, &scattering, &path, rules, index, radius);
#if DIRECT_LIGHT
        Ray shadow_ray;
        shadow_radiance[index] = pack(throughput * sample_direct_light(&scene, &surface, &scattering, u, false, &shadow_ray));
        shadow_rays[index] = shadow_ray;
#endif
        return;
    }
    Ray next;
    if (!continue_camera_path(&surface, &scattering, rules, &sampler, &path, &next)) return;
    rays[index] = next;
    paths[index] = path;
    flags[item] = PATH_ALIVE;
}
