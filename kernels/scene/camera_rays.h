// From film to rays, and from points back to film.
#ifndef SUNDOG_CAMERA_RAYS_H
#define SUNDOG_CAMERA_RAYS_H
#include "math/vec3.h"
#include "math/warp.h"
#include "shared/camera.h"
#include "shared/ray.h"

// Paths are numbered by tiles of the crop, so that neighbours in the list are neighbours in the image.
#define TILE_SIZE 8u

static inline uint2 pixel_of_path(uint path, uint width, uint height)
{
    const uint row = path / (TILE_SIZE * width); // of tiles
    const uint tile_height = min(TILE_SIZE, height - row * TILE_SIZE);
    const uint in_row = path - row * TILE_SIZE * width;
    const uint column = in_row / (TILE_SIZE * tile_height);
    const uint tile_width = min(TILE_SIZE, width - column * TILE_SIZE);
    const uint in_tile = in_row - column * TILE_SIZE * tile_height;
    return (uint2)(column * TILE_SIZE + in_tile % tile_width, row * TILE_SIZE + in_tile / tile_width);
}

static inline uint path_of_pixel(uint2 pixel, uint width, uint height)
{
    const uint2 tile = pixel / TILE_SIZE;
    const uint tile_height = min(TILE_SIZE, height - tile.y * TILE_SIZE);
    const uint tile_width = min(TILE_SIZE, width - tile.x * TILE_SIZE);
    const uint2 in_tile = pixel - tile * TILE_SIZE;
    return tile.y * TILE_SIZE * width + tile.x * TILE_SIZE * tile_height + in_tile.y * tile_width + in_tile.x;
}

// Offset from the pixel's centre, drawn from the |filter|; .y of the result is the sample's weight.
// Filter importance sampling [Ernst et al. 2006]: pixels need no splats.
static inline float2 sample_filter(__global const PixelFilter* filter, float u)
{
    // Largest bin whose cdf does not exceed u, by halving without branches.
    uint low = 0u;
    for (uint step = FILTER_BINS / 2u; step > 0u; step /= 2u) low += filter->cdf[low + step] <= u ? step : 0u;
    const float start = filter->cdf[low];
    const float width = filter->cdf[low + 1u] - start;
    const float fraction = width > 0.0f ? (u - start) / width : 0.5f;
    return (float2)(filter->radius * (((float)low + fraction) * (2.0f / FILTER_BINS) - 1.0f), filter->sign_scale[low]);
}

// Direction in camera space, with z = 1, through a point of the full film (pixels from its upper left).
static inline float3 camera_direction(const Camera* camera, float2 film)
{
    const float2 ndc = 2.0f * film / (float2)((float)camera->film_width, (float)camera->film_height) - 1.0f;
    return (float3)(-ndc.x * camera->tan_half_x, -ndc.y * camera->tan_half_y, 1.0f);
}

static inline float3 camera_to_world(const Camera* camera, float3 v)
{
    return unpack(camera->axis_x) * v.x + unpack(camera->axis_y) * v.y + unpack(camera->axis_z) * v.z;
}

static inline Ray camera_ray(const Camera* camera, float2 film, float2 lens)
{
    float3 direction = camera_direction(camera, film);
    float3 origin = (float3)(0.0f);
    if (camera->aperture_radius > 0.0f) {
        origin.xy = camera->aperture_radius * sample_disk(lens);
        direction = direction - origin / camera->focus_distance; // towards the point in focus; z stays 1
    }
    // Distances along camera z become ray parameters by the ray's length per unit of z.
    const float length_per_z = length(direction);
    const float3 world = camera_to_world(camera, direction) / length_per_z;
    Ray ray;
    ray.origin = pack(unpack(camera->position) + camera_to_world(camera, origin) + world * (camera->near_clip * length_per_z));
    ray.direction = pack(world);
    ray.t_max = (camera->far_clip - camera->near_clip) * length_per_z;
    ray.unused = 0u;
    return ray;
}

// How a point on the lens sees a point of the scene.
typedef struct CameraConnection {
    float3 lens;       // on the aperture
    float2 film;       // full film, pixels
    float importance;  // We / pdf of the lens point, per pixel area: times cos / d^2 at the scene it gives 1 / m^2
    bool visible;      // within field of view and clip planes
} CameraConnection;

// [Veach 1997, section 8.3.2]; We of a pinhole camera is 1 / (A cos^3) for a film of area A at distance 1, with
// the cosine at the lens taken out here because the caller's geometry term has none.
static inline CameraConnection connect_to_camera(const Camera* camera, float3 point, float2 u)
{
    CameraConnection connection;
    float3 lens = (float3)(0.0f);
    if (camera->aperture_radius > 0.0f) lens.xy = camera->aperture_radius * sample_disk(u);
    connection.lens = unpack(camera->position) + camera_to_world(camera, lens);
    const float3 to_point = point - connection.lens;
    const float z = dot(to_point, unpack(camera->axis_z));
    connection.visible = z > camera->near_clip && z < camera->far_clip;
    float3 direction = (float3)(dot(to_point, unpack(camera->axis_x)), dot(to_point, unpack(camera->axis_y)), z) / z;
    // Where the ray through the lens point meets the plane in focus decides the film position.
    if (camera->aperture_radius > 0.0f) direction += lens / camera->focus_distance;
    const float2 size = (float2)((float)camera->film_width, (float)camera->film_height);
    connection.film = 0.5f * size * (1.0f - direction.xy / (float2)(camera->tan_half_x, camera->tan_half_y));
    const float3 to_film = to_point / z; // z = 1: its length is 1 / cos at the lens
    const float inverse_cos = length(to_film);
    const float pixel_area = 4.0f * camera->tan_half_x * camera->tan_half_y / (size.x * size.y);
    connection.importance = inverse_cos * inverse_cos * inverse_cos / pixel_area;
    return connection;
}

#endif
