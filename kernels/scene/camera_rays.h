// From film to rays, and from points back to film.
#ifndef SUNDOG_CAMERA_RAYS_H
#define SUNDOG_CAMERA_RAYS_H
#include "math/vec3.h"
#include "math/warp.h"
#include "shared/camera.h"
#include "shared/ray.h"

// Programs are built for one kind of camera (-D CAMERA_KIND); without that the record itself says which it is.
#ifndef CAMERA_KIND
#define CAMERA_KIND camera->kind
#endif

// What lens and camera see each other by passes lights that are hidden (-D HIDE_EMITTERS).
#ifdef HIDE_EMITTERS
#define HORIZON_OF_LENS RAY_FROM_LENS
#else
#define HORIZON_OF_LENS 0u
#endif

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

static inline bool is_orthographic(const Camera* camera)
{
    return CAMERA_KIND == CAMERA_ORTHOGRAPHIC;
}

static inline float2 film_size(const Camera* camera)
{
    return (float2)((float)camera->film_width, (float)camera->film_height);
}

// Position along axis_x and axis_y of a point of the full film (pixels from its upper left).
static inline float2 film_position(const Camera* camera, float2 film)
{
    const float2 ndc = 2.0f * film / film_size(camera) - 1.0f;
    return (float2)(camera->shift_x, camera->shift_y) - ndc * (float2)(camera->half_width, camera->half_height);
}

// The inverse of film_position.
static inline float2 film_at(const Camera* camera, float2 position)
{
    const float2 centred = position - (float2)(camera->shift_x, camera->shift_y);
    return 0.5f * film_size(camera) * (1.0f - centred / (float2)(camera->half_width, camera->half_height));
}

// In the units of half_width, squared.
static inline float film_pixel_area(const Camera* camera)
{
    const float2 size = film_size(camera);
    return 4.0f * camera->half_width * camera->half_height / (size.x * size.y);
}

static inline float3 camera_to_world(const Camera* camera, float3 v)
{
    return unpack(camera->axis_x) * v.x + unpack(camera->axis_y) * v.y + unpack(camera->axis_z) * v.z;
}

static inline float3 world_to_camera(const Camera* camera, float3 v)
{
    return (float3)(dot(v, unpack(camera->axis_x)), dot(v, unpack(camera->axis_y)), dot(v, unpack(camera->axis_z)));
}

// A point of the aperture, which lies about the place where the ray in the lens's middle crosses it.
static inline float2 sample_aperture(const Camera* camera, float2 u)
{
    return camera->aperture_radius > 0.0f ? camera->aperture_radius * sample_disk(u) : (float2)(0.0f);
}

static inline Ray camera_ray(const Camera* camera, float2 film, float2 lens)
{
    const float2 position = film_position(camera, film);
    float3 origin = (float3)(is_orthographic(camera) ? position : (float2)(0.0f), 0.0f);
    float3 direction = (float3)(is_orthographic(camera) ? (float2)(0.0f) : position, 1.0f);
    if (camera->aperture_radius > 0.0f) {
        const float2 aperture = sample_aperture(camera, lens);
        origin.xy += aperture;
        direction.xy -= aperture / camera->focus_distance; // towards the point in focus; z stays 1
    }
    // Distances along camera z become ray parameters by the ray's length per unit of z.
    const float length_per_z = length(direction);
    const float3 world = camera_to_world(camera, direction) / length_per_z;
    Ray ray;
    ray.origin = pack(unpack(camera->position) + camera_to_world(camera, origin) + world * (camera->near_clip * length_per_z));
    ray.direction = pack(world);
    ray.t_max = (camera->far_clip - camera->near_clip) * length_per_z;
    ray.horizon = HORIZON_OF_LENS;
    return ray;
}

// From the camera, as the depth channel has it: from the lens, or orthographic from the film's plane.
static inline float camera_distance(const Camera* camera, float3 point)
{
    const float3 to_point = point - unpack(camera->position);
    return is_orthographic(camera) ? dot(to_point, unpack(camera->axis_z)) : length(to_point);
}

// Density of a pixel's camera subpaths (1/m^2, across the ray) at a distance along one of its rays of the given unit
// direction, which start at the near plane. The pixel filter counts as a box.
static inline float camera_ray_pdf_a(const Camera* camera, float3 direction, float distance)
{
    const float cos_z = dot(direction, unpack(camera->axis_z));
    const float on_film = 1.0f / (cos_z * film_pixel_area(camera));
    if (is_orthographic(camera)) return on_film;
    const float along_z = distance * cos_z + camera->near_clip;
    return on_film / (along_z * along_z);
}

// How a point on the lens sees a point of the scene.
typedef struct CameraConnection {
    float3 lens;       // on the aperture; orthographic without one: on the film, straight before the point
    float2 film;       // full film, pixels
    float importance;  // We / pdf of the lens point, per pixel area: times cos / d^2 at the scene it gives 1 / m^2
    bool visible;      // within the clip planes; whether within the film is for the caller to see
} CameraConnection;

// [Veach 1997, section 8.3.2]; We of a pinhole camera is 1 / (A cos^3) for a film of area A at distance 1, with
// the cosine at the lens taken out here because the caller's geometry term has none.
static inline CameraConnection connect_perspective(const Camera* camera, float3 point, float2 u)
{
    CameraConnection connection;
    const float2 lens = sample_aperture(camera, u);
    connection.lens = unpack(camera->position) + camera_to_world(camera, (float3)(lens, 0.0f));
    const float3 to_point = world_to_camera(camera, point - connection.lens);
    connection.visible = to_point.z > camera->near_clip && to_point.z < camera->far_clip;
    const float3 direction = to_point / to_point.z; // z = 1: its length is 1 / cos at the lens
    // Where the ray through the lens point meets the plane in focus decides the film position.
    const float2 refraction = camera->aperture_radius > 0.0f ? lens / camera->focus_distance : (float2)(0.0f);
    connection.film = film_at(camera, direction.xy + refraction);
    const float inverse_cos = length(direction);
    connection.importance = inverse_cos * inverse_cos * inverse_cos / film_pixel_area(camera);
    return connection;
}

// Each lens point has one direction in which all of the film looks: We is a delta in direction, and what connects is
// a density over the film's plane. An area dA at the scene covers dA cos / cos_z of that plane (cos_z: between the
// direction and axis_z), so that importance * cos / d^2 = cos / (cos_z * area of a pixel): the distance cancels.
static inline CameraConnection connect_orthographic(const Camera* camera, float3 point, float2 u)
{
    CameraConnection connection;
    const float3 to_point = world_to_camera(camera, point - unpack(camera->position));
    connection.visible = to_point.z > camera->near_clip && to_point.z < camera->far_clip;
    const float2 lens = sample_aperture(camera, u);
    // The ray leaves from film + lens and is back at film in the plane in focus.
    const float2 slope = camera->aperture_radius > 0.0f ? -lens / camera->focus_distance : (float2)(0.0f);
    const float2 origin = to_point.xy - slope * to_point.z;
    connection.lens = unpack(camera->position) + camera_to_world(camera, (float3)(origin, 0.0f));
    connection.film = film_at(camera, origin - lens);
    const float inverse_cos = length((float3)(slope, 1.0f));
    const float distance = to_point.z * inverse_cos;
    connection.importance = distance * distance * inverse_cos / film_pixel_area(camera);
    return connection;
}

static inline CameraConnection connect_to_camera(const Camera* camera, float3 point, float2 u)
{
    return is_orthographic(camera) ? connect_orthographic(camera, point, u) : connect_perspective(camera, point, u);
}

#endif
