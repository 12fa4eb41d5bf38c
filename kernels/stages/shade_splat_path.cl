// One vertex of a light path that is connected to the camera. Reads hits of the active paths; writes the
// shadow ray to the lens with the splat it would bring, the next ray, and whether the path goes on. One
// work-item an active path. Used by ptracer.
#include "scene/lens_connection.h"

__kernel void shade_splat_path(SURFACE_PARAMETERS, Camera camera, __global const PixelFilter* restrict filter, SAMPLER_PARAMETERS, PathRules rules, uint path_count,
                               __global const Hit* restrict hits, __global const uint* restrict active, __global const uint* restrict active_count,
                               __global Ray* restrict rays, __global PathState* restrict paths, __global Ray* restrict shadow_rays,
                               __global Splat* restrict deposits, __global uint* restrict flags)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint index = active[item];
    flags[item] = PATH_ENDED;
    shadow_rays[index].t_max = 0.0f;
    const Hit hit = hits[index];
    if (hit.primitive == NO_PRIMITIVE) return;

    const SurfaceView scene = SURFACE_VIEW;
    PathState path = paths[index];
    if (path.depth >= rules.max_depth) return;
    const Surface surface = surface_at(&scene, rays[index], hit);
    Sampler sampler = light_sampler(SAMPLER_VIEW, index, path_count, path.depth);
    const float4 u = next_4d(&sampler);
    Scattering scattering = scattering_at(&scene, &surface, next_4d(&sampler).x);
    disperse(light_hero(&scene, key, index), &path, &scattering);
    if (!is_specular(&scattering) && !is_black_side(&scattering)) {
        const LensConnection connection = connect_to_lens(&scene, &camera, filter, &surface, &scattering, unpack(path.throughput), u);
        deposits[item] = connection.splat;
        shadow_rays[index] = connection.shadow_ray;
    }
    Ray next;
    if (!continue_light_path(&surface, &scattering, rules, &sampler, &path, &next)) return;
    rays[index] = next;
    paths[index] = path;
    flags[item] = PATH_ALIVE;
}
