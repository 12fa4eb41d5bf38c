// Where light subpaths start.
#ifndef SUNDOG_SCENE_EMISSION_H
#define SUNDOG_SCENE_EMISSION_H
#include "math/sampler.h"
#include "scene/lights.h"
#include "shared/path.h"

typedef struct EmissionSample {
    Ray ray;
    float3 flux; // radiance * cos / pdf, W; the choice of the light is in it
    uint path_flags; // PATH_FROM_...
    uint light;
    // Densities: of the light's point (1/m^2) or, of a distant light, of the direction (1/sr), with the light's choice; 0 of a
    // point or direction that has no extent. And of the ray then: of its direction (1/sr) or, of a distant light, of where it
    // crosses the disk (1/m^2).
    float pdf_light;
    float pdf_ray;
    float cos_light; // at the light; 1 where it has no surface
} EmissionSample;

static inline Ray emission_ray(float3 origin, float3 direction)
{
    Ray ray;
    ray.origin = pack(origin);
    ray.direction = pack(direction);
    ray.t_max = INFINITY;
    ray.horizon = 0u;
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

// words: position, light, choice of a patch of an environment map. [Veach 1997, section 8.3.1]
static inline EmissionSample sample_emission(const SurfaceView* scene, uint4 words, float2 u_direction)
{
    const uint light_index = choose_light_by_power(scene, words.z).light;
    const Light light = scene->lights[light_index];
    const float4 u = unit_float4(words);
    const float3 emission = transport_emission(scene, unpack(light.emission)) / light.probability;
    const float disk_area = PI_F * scene->globals->radius * scene->globals->radius;
    EmissionSample sample;
    sample.path_flags = LIGHT_IS_DELTA(light.type) ? PATH_FROM_DELTA_LIGHT : 0u;
    sample.light = light_index;
    sample.pdf_light = 0.0f;
    sample.pdf_ray = 1.0f / disk_area;
    sample.cos_light = 1.0f;
    switch (light.type) {
    case LIGHT_POINT:
        sample.ray = emission_ray(unpack(light.position), sample_sphere(u_direction));
        sample.flux = emission * (4.0f * PI_F);
        sample.pdf_ray = point_light_pdf_w(scene, &light, unpack(sample.ray.direction));
        break;
    case LIGHT_SPOT: {
        const float half_sin = sin(0.5f * light.cutoff_angle);
        const float one_minus_cos = 2.0f * half_sin * half_sin;
        const float3 local_direction = sample_cone(u_direction, one_minus_cos);
        sample.ray = emission_ray(unpack(light.position), to_world(make_frame(unpack(light.direction)), local_direction));
        sample.flux = projected_intensity(scene, &light, unpack(sample.ray.direction)) * (2.0f * PI_F * one_minus_cos / light.probability);
        sample.pdf_ray = point_light_pdf_w(scene, &light, unpack(sample.ray.direction));
        break;
    }
#if LIGHT_OCCURS(LIGHT_PROJECTOR)
    case LIGHT_PROJECTOR: { // uniform on the image: the intensity's and the solid angle's cos^3 cancel
        const LightProjection projection = scene->light_projections[light.primitive];
        const float2 place = 2.0f * u_direction - 1.0f;
        const float3 direction = unpack(light.direction) + unpack(projection.axis_x) * (place.x * projection.half_width) +
                                 unpack(projection.axis_y) * (place.y * projection.half_height);
        sample.ray = emission_ray(unpack(light.position), normalize(direction));
        sample.flux = projected_emission(scene, &light, place) * (4.0f * projection.half_width * projection.half_height / light.probability);
        sample.pdf_ray = point_light_pdf_w(scene, &light, unpack(sample.ray.direction));
        break;
    }
#endif
    case LIGHT_DIRECTIONAL:
        sample.ray = distant_ray(scene, unpack(light.direction), u.xy);
        sample.flux = emission * disk_area;
        break;
    case LIGHT_COLLIMATED:
        sample.ray = emission_ray(unpack(light.position), unpack(light.direction));
        sample.flux = emission;
        sample.path_flags |= PATH_FROM_COLLIMATED_LIGHT;
        break;
    case LIGHT_CONSTANT:
        sample.ray = distant_ray(scene, sample_sphere(u_direction), u.xy);
        sample.flux = emission * (4.0f * PI_F * disk_area);
        sample.pdf_light = light.probability * (0.25f * INV_PI_F);
        break;
#if LIGHT_OCCURS(LIGHT_ENVMAP)
    case LIGHT_ENVMAP: {
        const EnvironmentMap map = scene->environment_maps[light.primitive];
        float3 direction;
        const EnvironmentValue value = sample_environment_map(scene, &map, u_direction, u.w, &direction);
        sample.ray = distant_ray(scene, -direction, u.xy);
        sample.flux = value.pdf_w > 0.0f ? transport_emission(scene, unpack(light.emission) / light.probability * value.radiance) * (disk_area / value.pdf_w) : (float3)(0.0f);
        sample.pdf_light = light.probability * value.pdf_w;
        break;
    }
#endif
    default: {
        const LightPoint point = sample_light_point(scene, &light, u.xy);
        const float3 direction = to_world(make_frame(point.normal), sample_cosine_hemisphere(u_direction));
        sample.ray = emission_ray(point.position + point.normal * point.offset, direction);
        sample.flux = light_point_radiance(scene, &light, &point) * (PI_F * light.area / light.probability);
        sample.pdf_light = light.probability / light.area;
        sample.cos_light = dot(direction, point.normal);
        sample.pdf_ray = sample.cos_light * INV_PI_F;
        break;
    }
    }
    return sample;
}

// Starts light path `path` of `count`: its first ray, and its state with flux as throughput.
static inline EmissionSample emit_light_path(const SurfaceView* scene, SamplerView numbers, uint path, uint count, PathState* state)
{
    Sampler sampler = light_sampler(numbers, path, count, 0u);
    const uint4 words = next_words(&sampler);
    const float4 u_direction = next_4d(&sampler);
    const EmissionSample emission = sample_emission(scene, words, u_direction.xy);
    const PathState first = {pack(emission.flux), PDF_DELTA, 1u, 0u, 1.0f, emission.path_flags};
    *state = first;
    return emission;
}

#endif
