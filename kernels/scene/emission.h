// Where light subpaths start.
#ifndef SUNDOG_SCENE_EMISSION_H
#define SUNDOG_SCENE_EMISSION_H
#include "scene/lights.h"

typedef struct EmissionSample {
    Ray ray;
    float3 flux; // radiance * cos / pdf, W; the choice of the light is in it
    bool from_delta_light;
} EmissionSample;

static inline Ray emission_ray(float3 origin, float3 direction)
{
    Ray ray;
    ray.origin = pack(origin);
    ray.direction = pack(direction);
    ray.t_max = INFINITY;
    ray.unused = 0u;
    return ray;
}

// A ray along `direction` from outside the scene, its origin uniform on the disk that faces the whole
// bounding sphere (of area pi R^2).
static inline Ray distant_ray(const SurfaceView* scene, float3 direction, float2 u)
{
    const float radius = scene->globals->radius;
    const float2 d = sample_disk(u);
    const Frame frame = make_frame(direction);
    return emission_ray(unpack(scene->globals->center) + radius * (frame.s * d.x + frame.t * d.y - direction), direction);
}

// u: light, direction and position. [Veach 1997, section 8.3.1]
static inline EmissionSample sample_emission(const SurfaceView* scene, float4 u, float2 u_direction)
{
    const Light light = scene->lights[choose_light(scene, u.z)];
    const float3 emission = transport_emission(scene, unpack(light.emission)) / light.probability;
    const float disk_area = PI_F * scene->globals->radius * scene->globals->radius;
    EmissionSample sample;
    sample.from_delta_light = LIGHT_IS_DELTA(light.type);
    switch (light.type) {
    case LIGHT_POINT:
        sample.ray = emission_ray(unpack(light.position), sample_sphere(u_direction));
        sample.flux = emission * (4.0f * PI_F);
        break;
    case LIGHT_SPOT: {
        const float half_sin = sin(0.5f * light.cutoff_angle);
        const float one_minus_cos = 2.0f * half_sin * half_sin;
        const float3 local_direction = sample_cone(u_direction, one_minus_cos);
        sample.ray = emission_ray(unpack(light.position), to_world(make_frame(unpack(light.direction)), local_direction));
        sample.flux = emission * spot_falloff(&light, local_direction.z) * (2.0f * PI_F * one_minus_cos);
        break;
    }
    case LIGHT_DIRECTIONAL:
        sample.ray = distant_ray(scene, unpack(light.direction), u.xy);
        sample.flux = emission * disk_area;
        break;
    case LIGHT_CONSTANT:
        sample.ray = distant_ray(scene, sample_sphere(u_direction), u.xy);
        sample.flux = emission * (4.0f * PI_F * disk_area);
        break;
    default: {
        const LightPoint point = sample_light_point(scene, &light, u.xy);
        const float3 direction = to_world(make_frame(point.normal), sample_cosine_hemisphere(u_direction));
        sample.ray = emission_ray(point.position + point.normal * point.offset, direction);
        sample.flux = emission * (PI_F * light.area);
        break;
    }
    }
    return sample;
}

#endif
