// One vertex of a light path that is connected to the camera. Reads hits of the active paths; writes the
// shadow ray to the lens with the splat it would bring, the next ray, and whether the path goes on. One
// work-item an active path. Used by ptracer.
#include "scene/camera_rays.h"
#include "scene/continue_path.h"
#include "scene/film_splat.h"
#include "shared/film.h"

// The splat of a vertex, 0 when the camera does not see it; its shadow ray runs to the lens.
static inline Splat connect_vertex(const Camera* camera, __global const PixelFilter* filter, const Surface* surface, const Scattering* scattering, const PathState* path,
                            float4 u, Ray* shadow_ray)
{
    Splat splat = {{0.0f, 0.0f, 0.0f}, 0u};
    *shadow_ray = no_ray();
    const CameraConnection connection = connect_to_camera(camera, surface->position, u.xy);
    if (!connection.visible) return splat;
    float weight_x, weight_y;
    const int x = choose_filter_pixel(filter, connection.film.x, u.z, &weight_x) - camera->crop_x;
    const int y = choose_filter_pixel(filter, connection.film.y, u.w, &weight_y) - camera->crop_y;
    if (x < 0 || y < 0 || x >= camera->crop_width || y >= camera->crop_height) return splat;

    const float3 to_lens = connection.lens - surface->position;
    const float distance_squared = dot(to_lens, to_lens);
    const float3 direction = to_lens * rsqrt(distance_squared);
    const float3 f = bsdf_evaluate(scattering, surface, direction, CARRIES_FLUX) * irradiance_scale(surface, scattering->normal);
    const float geometry = fabs(dot(direction, surface->geometric_normal)) / distance_squared;
    splat.radiance = pack(unpack(path->throughput) * f * (geometry * connection.importance * weight_x * weight_y));
    splat.pixel = path_of_pixel((uint2)((uint)x, (uint)y), camera->crop_width, camera->crop_height);
    if (is_black(f)) return splat;

    shadow_ray->origin = pack(ray_origin(surface, direction));
    shadow_ray->direction = pack(connection.lens - ray_origin(surface, direction));
    // Surfaces nearer to the lens than the near plane do not hide anything.
    const float z = -dot(to_lens, unpack(camera->axis_z));
    shadow_ray->t_max = 1.0f - camera->near_clip / z;
    return splat;
}

__kernel void shade_splat_path(SURFACE_PARAMETERS, Camera camera, __global const PixelFilter* restrict filter, SamplerKey key, PathRules rules, uint path_count,
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
    Sampler sampler = light_sampler(key, index, path_count, path.depth);
    const float4 u = next_4d(&sampler);
    Scattering scattering = scattering_at(&scene, &surface, next_4d(&sampler).x);
    disperse(light_hero(&scene, key, index), &path, &scattering);
    if (!is_specular(&scattering) && !is_black_side(&scattering)) {
        Ray shadow_ray;
        deposits[item] = connect_vertex(&camera, filter, &surface, &scattering, &path, u, &shadow_ray);
        shadow_rays[index] = shadow_ray;
    }
    Ray next;
    if (!continue_light_path(&surface, &scattering, rules, &sampler, &path, &next)) return;
    rays[index] = next;
    paths[index] = path;
    flags[item] = PATH_ALIVE;
}
