// One vertex of a camera path, with next-event estimation and BSDF sampling under multiple importance
// sampling. Reads hits of the active paths; adds emission to radiance; writes the light's shadow ray with
// what it would bring, the next ray, and whether the path goes on. One work-item an active path. Used by path.
#include "scene/camera_rays.h"
#include "scene/continue_path.h"
#include "scene/direct_light.h"

// Weight of emission that BSDF sampling found, against next-event estimation.
static inline float emission_weight(const PathState* path, float light_pdf)
{
    return path->pdf_w == PDF_DELTA ? 1.0f : balance_heuristic(path->pdf_w, light_pdf);
}

static inline float3 environment_radiance(const SurfaceView* scene, const PathState* path)
{
    const uint light = scene->globals->constant_light;
    if (light == NO_LIGHT) return (float3)(0.0f);
    return unpack(scene->lights[light].emission) * emission_weight(path, constant_light_pdf_w(scene));
}

static inline float3 surface_radiance(const SurfaceView* scene, const Surface* surface, const PathState* path, Ray ray)
{
    const uint light = light_of_hit(scene, surface);
    const float3 emitted = emitted_radiance(scene, surface, light);
    if (is_black(emitted)) return emitted;
    return emitted * emission_weight(path, light_pdf_w(scene, surface, light, unpack(ray.origin)));
}

__kernel void shade_camera_path(SURFACE_PARAMETERS, SamplerKey key, PathRules rules, uint width, uint height, __global const Hit* restrict hits,
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
        radiance[index] = pack(unpack(radiance[index]) + throughput * environment_radiance(&scene, &path));
        return;
    }
    const Ray ray = rays[index];
    const Surface surface = surface_at(&scene, ray, hit);
    const float3 emitted = surface_radiance(&scene, &surface, &path, ray);
    if (!is_black(emitted)) radiance[index] = pack(unpack(radiance[index]) + throughput * emitted);
    if (path.depth >= rules.max_depth) return;

    const Scattering scattering = scattering_at(&scene, &surface);
    const uint2 pixel = pixel_of_path(index, width, height);
    Sampler sampler = camera_sampler(key, pixel.y * width + pixel.x, path.depth);
    const float4 u = next_4d(&sampler);
    if (!is_specular(&scattering) && !is_black_side(&scattering)) {
        Ray shadow_ray;
        shadow_radiance[index] = pack(throughput * sample_direct_light(&scene, &surface, &scattering, u, true, &shadow_ray));
        shadow_rays[index] = shadow_ray;
    }
    Ray next;
    if (!continue_camera_path(&surface, &scattering, rules, &sampler, &path, &next)) return;
    rays[index] = next;
    paths[index] = path;
    flags[item] = PATH_ALIVE;
}
