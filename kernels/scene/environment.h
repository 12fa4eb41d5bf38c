// Radiance of an environment map, and directions drawn in proportion to it.
#ifndef SUNDOG_SCENE_ENVIRONMENT_H
#define SUNDOG_SCENE_ENVIRONMENT_H
#include "math/frame.h"
#include "math/luminance.h"
#include "math/warp.h"
#include "scene/scene_view.h"

#define LEAST_SINE 1e-6f // at a pole the density has no bound, the radiance over it goes to zero

// Radiance from a direction, and the density (1/sr) with which sample_environment_map draws it.
typedef struct EnvironmentValue {
    float3 radiance;
    float pdf_w;
} EnvironmentValue;

static inline float3 read_radiance(const SurfaceView* scene, size_t index)
{
    return (float3)(as_float(scene->texels[index]), as_float(scene->texels[index + 1u]), as_float(scene->texels[index + 2u]));
}

static inline float3 read_environment_texel(const SurfaceView* scene, const EnvironmentMap* map, uint x, uint y)
{
    return read_radiance(scene, map->first_texel + 3u * ((size_t)y * map->width + x));
}

// What the image alone has from a direction, and the sun where the direction lies within its disk: measured across the
// axis, because small angles have no digits in a cosine.
static inline EnvironmentValue with_sun(const SurfaceView* scene, const EnvironmentMap* map, float3 direction, EnvironmentValue value)
{
    if (map->sun_share == 0.0f) return value;
    value.pdf_w *= 1.0f - map->sun_share;
    const float3 axis = unpack(map->sun_direction), tangent = unpack(map->sun_tangent);
    const float2 across = (float2)(dot(direction, tangent), dot(direction, cross(axis, tangent)));
    const float sin2 = map->sun_one_minus_cos * (2.0f - map->sun_one_minus_cos);
    if (dot(across, across) > sin2 || dot(direction, axis) <= 0.0f) return value;
    const float last = (float)(map->sun_width - 1u);
    const float2 place = clamp((0.5f + 0.5f * across * rsqrt(sin2)) * last, 0.0f, last);
    const uint x = min((uint)place.x, map->sun_width - 2u), y = min((uint)place.y, map->sun_width - 2u);
    const size_t index = map->sun_first_texel + 3u * ((size_t)y * map->sun_width + x), below = index + 3u * map->sun_width;
    const float2 t = place - (float2)((float)x, (float)y);
    value.radiance += mix(mix(read_radiance(scene, index), read_radiance(scene, index + 3u), t.x),
                          mix(read_radiance(scene, below), read_radiance(scene, below + 3u), t.x), t.y);
    value.pdf_w += map->sun_share / (2.0f * PI_F * map->sun_one_minus_cos);
    return value;
}

// Of the image alone: in patch (x, y) at t in [0, 1]^2.
static inline EnvironmentValue environment_patch(const SurfaceView* scene, const EnvironmentMap* map, uint x, uint y, float2 t, float sine)
{
    const uint x1 = x + 1u < map->width ? x + 1u : 0u, y1 = min(y + 1u, map->height - 1u);
    const float3 a = read_environment_texel(scene, map, x, y), b = read_environment_texel(scene, map, x1, y);
    const float3 c = read_environment_texel(scene, map, x, y1), d = read_environment_texel(scene, map, x1, y1);
    const float weight = dot(a + b + c + d, LUMINANCE_WEIGHTS) * (0.25f * sin(map->polar_range * ((float)y + 0.5f) / (float)map->rows));
    EnvironmentValue value;
    value.radiance = mix(mix(a, b, t.x), mix(c, d, t.x), t.y);
    value.pdf_w = map->pdf_scale * weight / fmax(sine, LEAST_SINE);
    return value;
}

// direction: unit, away from the scene. As in Mitsuba: columns run from -z over +x to +z and back, the image's first
// column begins at -z; the centres of its first and last row are the poles.
static inline EnvironmentValue environment_map_value(const SurfaceView* scene, const EnvironmentMap* map, float3 direction)
{
    const float3 local_direction = (float3)(dot(direction, unpack(map->axis_x)), dot(direction, unpack(map->axis_y)), dot(direction, unpack(map->axis_z)));
    const float sine = sqrt(local_direction.x * local_direction.x + local_direction.z * local_direction.z);
    float turn = atan2(local_direction.x, -local_direction.z) * (0.5f * INV_PI_F);
    if (turn < 0.0f) turn += 1.0f;
    const float polar = atan2(sine, local_direction.y);
    const float2 place = (float2)(turn * (float)map->width - 0.5f, polar * map->inverse_polar_range * (float)map->rows);
    const int x = (int)floor(place.x);
    const uint y = min((uint)place.y, map->rows - 1u);
    const float2 t = clamp((float2)(place.x - (float)x, place.y - (float)y), 0.0f, 1.0f);
    EnvironmentValue value = {(float3)(0.0f), 0.0f};
    if (polar <= map->polar_range || map->polar_range >= PI_F)
        value = environment_patch(scene, map, x < 0 ? map->width - 1u : min((uint)x, map->width - 1u), y, t, sine);
    return with_sun(scene, map, direction, value);
}

// A direction away from the scene: in the sun's disk, or by the image. There u chooses a column of the alias table and the
// place in the patch, choice whether the column's alias is taken: so all three keep their digits for maps of any size.
static inline EnvironmentValue sample_environment_map(const SurfaceView* scene, const EnvironmentMap* map, float2 u, float choice, float3* direction)
{
    if (choice < map->sun_share) {
        const float3 axis = unpack(map->sun_direction), tangent = unpack(map->sun_tangent);
        const float3 local_direction = sample_cone(u, map->sun_one_minus_cos);
        *direction = tangent * local_direction.x + cross(axis, tangent) * local_direction.y + axis * local_direction.z;
        return environment_map_value(scene, map, *direction);
    }
    choice = (choice - map->sun_share) / (1.0f - map->sun_share);
    const float2 scaled = u * (float2)((float)map->width, (float)map->rows);
    uint x = min((uint)scaled.x, map->width - 1u), y = min((uint)scaled.y, map->rows - 1u);
    const float2 t = clamp(scaled - (float2)((float)x, (float)y), 0.0f, 1.0f);
    const AliasEntry entry = scene->environment_alias[(size_t)y * map->width + x];
    if (choice >= entry.threshold) {
        x = entry.alias % map->width;
        y = entry.alias / map->width;
    }
    const float azimuth = (2.0f * PI_F) * (((float)x + t.x + 0.5f) / (float)map->width);
    const float polar = map->polar_range * (((float)y + t.y) / (float)map->rows);
    float cos_azimuth, cosine;
    const float sin_azimuth = sincos(azimuth, &cos_azimuth), sine = sincos(polar, &cosine);
    *direction = unpack(map->axis_x) * (sine * sin_azimuth) + unpack(map->axis_y) * cosine - unpack(map->axis_z) * (sine * cos_azimuth);
    return with_sun(scene, map, *direction, environment_patch(scene, map, x, y, t, sine));
}

#endif
