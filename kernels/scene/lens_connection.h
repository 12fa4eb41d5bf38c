// A vertex of a light subpath as the camera sees it.
#ifndef SUNDOG_SCENE_LENS_CONNECTION_H
#define SUNDOG_SCENE_LENS_CONNECTION_H
#include "scene/camera_rays.h"
#include "scene/continue_path.h"
#include "scene/film_splat.h"
#include "shared/film.h"

typedef struct LensConnection {
    Splat splat;      // 0 when the camera does not see the vertex
    Ray shadow_ray;   // to the lens; no_ray() when there is nothing to ask
    float3 direction; // unit, to the lens
    float pdf_a;      // 1/m^2, with which a camera subpath of that pixel meets the surface there
} LensConnection;

// Whether the lens passes a surface, because it belongs to a light that is hidden.
static inline bool is_hidden(const SurfaceView* scene, const Surface* surface)
{
#ifdef HIDE_EMITTERS
    return scene->shapes[surface->shape].first_light != NO_LIGHT;
#else
    return false;
#endif
}

// flux: of the light subpath, W. u: lens and pixel filter.
static inline LensConnection connect_to_lens(const SurfaceView* scene, const Camera* camera, __global const PixelFilter* filter, const Surface* surface,
                                             const Scattering* scattering, float3 flux, float4 u)
{
    LensConnection result;
    result.splat.radiance = pack((float3)(0.0f));
    result.splat.pixel = 0u;
    result.shadow_ray = no_ray();
    if (is_hidden(scene, surface)) return result;
    const CameraConnection connection = connect_to_camera(camera, surface->position, u.xy);
    if (!connection.visible) return result;
    const float3 to_lens = connection.lens - surface->position;
    const float distance_squared = dot(to_lens, to_lens);
    result.direction = to_lens * rsqrt(distance_squared);
    const float3 f = bsdf_evaluate(scattering, surface, result.direction, CARRIES_FLUX) * irradiance_scale(surface, scattering->normal);
    if (is_black(f)) return result;

    float weight_x, weight_y;
    const int x = choose_filter_pixel(filter, connection.film.x, u.z, &weight_x) - camera->crop_x;
    const int y = choose_filter_pixel(filter, connection.film.y, u.w, &weight_y) - camera->crop_y;
    if (x < 0 || y < 0 || x >= camera->crop_width || y >= camera->crop_height) return result;
    result.pdf_a = fabs(dot(result.direction, surface->geometric_normal)) / distance_squared * connection.importance;
    result.splat.radiance = pack(flux * f * (result.pdf_a * weight_x * weight_y));
    result.splat.pixel = path_of_pixel((uint2)((uint)x, (uint)y), camera->crop_width, camera->crop_height);

    const float3 origin = ray_origin(surface, result.direction);
    result.shadow_ray.origin = pack(origin);
    result.shadow_ray.direction = pack(connection.lens - origin);
    result.shadow_ray.horizon = HORIZON_OF_LENS;
    // Surfaces nearer to the lens than the near plane do not hide anything.
    result.shadow_ray.t_max = 1.0f + camera->near_clip / dot(to_lens, unpack(camera->axis_z));
    return result;
}

#endif
