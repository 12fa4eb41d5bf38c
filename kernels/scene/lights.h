// Light sources: choosing one, sampling points as seen from a surface, and densities for MIS.
#ifndef SUNDOG_SCENE_LIGHTS_H
#define SUNDOG_SCENE_LIGHTS_H
#include "math/frame.h"
#include "math/warp.h"
#include "scene/environment.h"
#include "scene/light_choice.h"
#include "scene/spectral.h"
#include "scene/surface.h"
#include "scene/texture.h"
#include "shared/path.h"

// -D LIGHT_TYPES: bit t is set where the scene has lights of type t; the others are compiled out, where that saves.
#ifndef LIGHT_TYPES
#define LIGHT_TYPES 0xffffffffu
#endif
#define LIGHT_OCCURS(type) ((LIGHT_TYPES >> (type)) & 1u)

// A light as a shaded point sees it.
typedef struct LightSample {
    float3 direction; // unit, towards the light
    Ray shadow_ray;   // from the surface's offset origin to just before the light
    float3 radiance;  // arriving radiance over pdf_w: times f |cos| it is the estimate
    float pdf_w;      // 1/sr, the light's choice included; PDF_DELTA for point-like lights
    // Density of light subpaths here, 1/m^2 across the direction, if they choose the light's point (or direction) as this
    // sample did: what weighs them against it.
    float emission_ratio;
} LightSample;

// A light's emission times what its texture, if it has one, says at a surface: as transport computes with it.
static inline float3 textured_emission(const SurfaceView* scene, const Light* light, const Surface* surface)
{
#if HAS_UV
    const TexturedColor color = {light->emission, light->texture};
    return transport_emission(scene, textured_color(scene, color, surface));
#else
    return transport_emission(scene, unpack(light->emission));
#endif
}

// A point on an area light, uniform in area.
typedef struct LightPoint {
    float2 weights; // barycentric, of the second and third vertex
    float3 position;
    float3 normal;
    float offset; // as in Surface
} LightPoint;

static inline LightPoint sample_light_point(const SurfaceView* scene, const Light* light, float2 u)
{
    LightPoint point;
    if (light->type == LIGHT_TRIANGLE) {
        const Triangle triangle = scene->triangles[light->primitive];
        const float3 a = unpack(scene->positions[triangle.vertex[0]]);
        const float3 b = unpack(scene->positions[triangle.vertex[1]]);
        const float3 c = unpack(scene->positions[triangle.vertex[2]]);
        const float2 weights = sample_triangle(u);
        point.weights = weights;
        point.position = a + (b - a) * weights.x + (c - a) * weights.y;
        point.normal = normalize(cross(b - a, c - a));
        point.offset = OFFSET_PER_COORDINATE * fmax(max_abs(a), fmax(max_abs(b), max_abs(c)));
        return point;
    }
    const AnalyticPrimitive primitive = scene->analytics[light->primitive & ~ANALYTIC_BIT];
    const float3 center = unpack(primitive.center);
    if (light->type == LIGHT_SPHERE) {
        const float3 outwards = sample_sphere(u);
        point.position = center + outwards * primitive.radius;
        point.normal = (scene->shapes[primitive.shape].flags & SHAPE_FLIP_NORMALS) ? -outwards : outwards;
        point.offset = OFFSET_PER_COORDINATE * (max_abs(center) + primitive.radius);
    } else if (light->type == LIGHT_CYLINDER) {
        float cosine;
        const float sine = sincos(2.0f * PI_F * u.x, &cosine);
        const float3 outwards = cosine * unpack(primitive.axis_u) + sine * unpack(primitive.axis_v);
        point.position = center + (u.y * primitive.length) * unpack(primitive.normal) + outwards * primitive.radius;
        point.normal = (scene->shapes[primitive.shape].flags & SHAPE_FLIP_NORMALS) ? -outwards : outwards;
        point.offset = OFFSET_PER_COORDINATE * (max_abs(center) + primitive.radius + primitive.length);
    } else {
        const float2 d = sample_disk(u);
        point.position = center + d.x * unpack(primitive.axis_u) + d.y * unpack(primitive.axis_v);
        point.normal = unpack(primitive.normal);
        point.offset = OFFSET_PER_COORDINATE * (max_abs(center) + max_abs(unpack(primitive.axis_u)) + max_abs(unpack(primitive.axis_v)));
    }
    return point;
}

// Radiance of an area light at a point of it.
static inline float3 light_point_radiance(const SurfaceView* scene, const Light* light, const LightPoint* point)
{
#if HAS_UV
    if (light->texture != NO_TEXTURE) {
        Surface surface;
        surface.primitive = light->primitive;
        const Hit hit = {0.0f, point->weights.x, point->weights.y, light->primitive};
        if (light->type == LIGHT_TRIANGLE) triangle_surface(scene, hit, &surface);
        else analytic_surface(scene, hit, point->position, &surface);
        return textured_emission(scene, light, &surface);
    }
#endif
    return transport_emission(scene, unpack(light->emission));
}

// The texture of a spot or projector at the point (x, y) of its image, in [-1, 1]^2 (kernels/shared/light.h).
static inline float3 projected_emission(const SurfaceView* scene, const Light* light, float2 place)
{
    Surface surface;
    surface.primitive = ANALYTIC_BIT; // of no mesh
#if HAS_UV
    surface.uv = 0.5f - 0.5f * place;
#endif
    return textured_emission(scene, light, &surface);
}

// Where a direction with the given cosine to the light's axis meets its image.
static inline float2 projected_place(const LightProjection* projection, float3 direction, float cosine)
{
    return (float2)(dot(direction, unpack(projection->axis_x)) / projection->half_width,
                    dot(direction, unpack(projection->axis_y)) / projection->half_height) / cosine;
}

// Fall-off of a spot at `angle` from its axis: linear between beam width and cut-off, as in Mitsuba.
static inline float spot_falloff(const Light* light, float cos_angle)
{
    const float angle = acos(clamp(cos_angle, -1.0f, 1.0f));
    if (angle >= light->cutoff_angle) return 0.0f;
    return angle <= light->beam_width ? 1.0f : (light->cutoff_angle - angle) / (light->cutoff_angle - light->beam_width);
}

// Radiant intensity (W/sr) of a spot or projector in a direction (unit).
static inline float3 projected_intensity(const SurfaceView* scene, const Light* light, float3 direction)
{
    const float cosine = dot(direction, unpack(light->direction));
    const float falloff = light->type == LIGHT_SPOT ? spot_falloff(light, cosine) : 1.0f;
    if (light->type == LIGHT_SPOT && light->texture == NO_TEXTURE) return transport_emission(scene, unpack(light->emission)) * falloff;
    if (falloff == 0.0f || cosine < 1e-4f) return (float3)(0.0f);
    const LightProjection projection = scene->light_projections[light->primitive];
    const float2 place = projected_place(&projection, direction, cosine);
    const float3 emission = projected_emission(scene, light, place) * falloff;
    if (light->type == LIGHT_SPOT) return emission;
    // E = I cos / r^2 at r = 1 / cos.
    return fmax(fabs(place.x), fabs(place.y)) <= 1.0f ? emission / (cosine * cosine * cosine) : (float3)(0.0f);
}

// Density (1/sr) of the direction of a light subpath from a point, spot or projector.
static inline float point_light_pdf_w(const SurfaceView* scene, const Light* light, float3 direction)
{
    if (light->type == LIGHT_POINT) return 0.25f * INV_PI_F;
    const float cosine = dot(direction, unpack(light->direction));
    if (light->type == LIGHT_SPOT) {
        const float half_sin = sin(0.5f * light->cutoff_angle);
        return 1.0f / (4.0f * PI_F * half_sin * half_sin);
    }
    const LightProjection projection = scene->light_projections[light->primitive]; // uniform on its image
    return 1.0f / (4.0f * projection.half_width * projection.half_height * fmax(cosine * cosine * cosine, 1e-12f));
}

// Density (1/m^2) of where a light subpath from a distant light crosses the disk that its rays start on.
static inline float distant_ray_pdf_a(const SurfaceView* scene)
{
    return INV_PI_F / (scene->globals->radius * scene->globals->radius);
}

static inline Ray segment(float3 from, float3 to)
{
    Ray ray;
    ray.origin = pack(from);
    ray.direction = pack(to - from);
    ray.t_max = 1.0f;
    ray.horizon = 0u;
    return ray;
}

// From a surface to just before a point on a light. The end is off the light by the offsets of both: rounding
// moves it by ulps of the larger coordinates.
static inline Ray segment_to(const Surface* surface, float3 direction, const LightPoint* point)
{
    return segment(ray_origin(surface, direction), point->position + point->normal * (point->offset + surface->offset));
}

// A sphere seen from outside subtends a cone: sampling it leaves no noise from the cosine at the light.
// 1 - cos of the cone's half angle; 2 (the whole sphere of directions) when the point is not outside.
static inline float sphere_one_minus_cos(float radius, float distance_squared)
{
    const float sin2 = radius * radius / distance_squared;
    if (sin2 >= 1.0f) return 2.0f;
    return sin2 / (1.0f + sqrt(1.0f - sin2));
}

// Area to solid angle [1/m^2 -> 1/sr].
static inline float pdf_w_from_a(float pdf_a, float distance_squared, float cos_at_light) { return pdf_a * distance_squared / cos_at_light; }

// probability: of the light's choice.
static inline bool sample_area_light(const SurfaceView* scene, const Surface* surface, const Light* light, float probability, float2 u, LightSample* sample)
{
    LightPoint point;
    if (light->type == LIGHT_SPHERE) {
        const AnalyticPrimitive primitive = scene->analytics[light->primitive & ~ANALYTIC_BIT];
        const float3 to_center = unpack(primitive.center) - surface->position;
        const float distance_squared = dot(to_center, to_center);
        const float one_minus_cos = sphere_one_minus_cos(primitive.radius, distance_squared);
        const bool flipped = (scene->shapes[primitive.shape].flags & SHAPE_FLIP_NORMALS) != 0u;
        if (one_minus_cos < 2.0f && !flipped) {
            const float distance = sqrt(distance_squared);
            const float3 direction = to_world(make_frame(to_center / distance), sample_cone(u, one_minus_cos));
            // Nearer of the two intersections of that direction with the sphere.
            const float along = dot(direction, to_center);
            const float3 miss = to_center - direction * along;
            const float half_chord = sqrt(fmax(0.0f, primitive.radius * primitive.radius - dot(miss, miss)));
            point.position = surface->position + direction * (along - half_chord);
            point.normal = normalize(point.position - unpack(primitive.center));
            point.offset = OFFSET_PER_COORDINATE * (max_abs(unpack(primitive.center)) + primitive.radius);
            sample->direction = direction;
            sample->pdf_w = probability / (2.0f * PI_F * one_minus_cos);
            sample->shadow_ray = segment_to(surface, direction, &point);
            sample->radiance = light_point_radiance(scene, light, &point) / sample->pdf_w;
            sample->emission_ratio = light->probability / (light->area * PI_F * sample->pdf_w);
            return true;
        }
    }
    point = sample_light_point(scene, light, u);
    const float3 to_light = point.position - surface->position;
    const float distance_squared = dot(to_light, to_light);
    sample->direction = to_light * rsqrt(distance_squared);
    const float cos_at_light = -dot(sample->direction, point.normal);
    if (!(cos_at_light > 0.0f) || !(distance_squared > 0.0f)) return false;
    sample->pdf_w = pdf_w_from_a(probability / light->area, distance_squared, cos_at_light);
    sample->radiance = light_point_radiance(scene, light, &point) / sample->pdf_w;
    sample->shadow_ray = segment_to(surface, sample->direction, &point);
    sample->emission_ratio = light->probability / (light->area * PI_F * sample->pdf_w); // p_point cos / pi (d^2 / cos pdf_w) / d^2
    return true;
}

// Samples the lights as seen from a surface. `horizon`: of the surface (kernels/scene/horizon.h). words: position, choice.
// False: no light that way.
static inline bool sample_light(const SurfaceView* scene, const Surface* surface, uint horizon, uint4 words, LightSample* sample)
{
    const LightChoice choice = choose_light(scene, surface->position, horizon, words.z);
    if (LIGHT_TREE && choice.light == NO_LIGHT) return false;
    const float2 u = unit_float4(words).xy;
    const float probability = choice.probability;
    const Light light = scene->lights[choice.light];
    switch (light.type) {
    case LIGHT_POINT:
    case LIGHT_SPOT:
    case LIGHT_PROJECTOR: {
        const float3 to_light = unpack(light.position) - surface->position;
        const float distance_squared = dot(to_light, to_light);
        sample->direction = to_light * rsqrt(distance_squared);
        float3 intensity = transport_emission(scene, unpack(light.emission));
        if (light.type != LIGHT_POINT) intensity = projected_intensity(scene, &light, -sample->direction);
        sample->radiance = intensity / (distance_squared * probability);
        sample->pdf_w = PDF_DELTA;
        sample->shadow_ray = segment(ray_origin(surface, sample->direction), unpack(light.position));
        sample->emission_ratio = light.probability / probability * point_light_pdf_w(scene, &light, -sample->direction) / distance_squared;
        return distance_squared > 0.0f && !is_black(intensity);
    }
    case LIGHT_DIRECTIONAL:
        sample->direction = -unpack(light.direction);
        sample->radiance = transport_emission(scene, unpack(light.emission)) / probability;
        sample->pdf_w = PDF_DELTA;
        sample->shadow_ray = ray_from(surface, sample->direction);
        sample->emission_ratio = light.probability / probability * distant_ray_pdf_a(scene);
        return true;
    case LIGHT_COLLIMATED: return false; // of all points only those on one ray see it
    case LIGHT_CONSTANT:
        sample->direction = sample_sphere(u);
        sample->pdf_w = probability * (0.25f * INV_PI_F);
        sample->radiance = transport_emission(scene, unpack(light.emission)) / sample->pdf_w;
        sample->shadow_ray = ray_from(surface, sample->direction);
        sample->emission_ratio = light.probability / probability * distant_ray_pdf_a(scene);
        return true;
#if LIGHT_OCCURS(LIGHT_ENVMAP)
    case LIGHT_ENVMAP: {
        const EnvironmentMap map = scene->environment_maps[light.primitive];
        const EnvironmentValue value = sample_environment_map(scene, &map, u, choice.rest, &sample->direction);
        sample->pdf_w = probability * value.pdf_w;
        sample->radiance = transport_emission(scene, unpack(light.emission) * value.radiance) / sample->pdf_w;
        sample->shadow_ray = ray_from(surface, sample->direction);
        sample->emission_ratio = light.probability / probability * distant_ray_pdf_a(scene);
        return value.pdf_w > 0.0f;
    }
#endif
    default: return sample_area_light(scene, surface, &light, probability, u, sample);
    }
}

// The light that a hit primitive is, or NO_LIGHT.
static inline uint light_of_hit(const SurfaceView* scene, const Surface* surface)
{
    const Shape shape = scene->shapes[surface->shape];
    return shape.first_light == NO_LIGHT ? NO_LIGHT : shape.first_light + ((surface->primitive & ~ANALYTIC_BIT) - shape.first_primitive);
}

// Radiance that a hit surface emits back along the ray; zero from its back.
static inline float3 emitted_radiance(const SurfaceView* scene, const Surface* surface, uint light)
{
    const bool front = dot(surface->geometric_normal, surface->outgoing) > 0.0f;
    if (light == NO_LIGHT || !front) return (float3)(0.0f);
    const Light source = scene->lights[light];
    return textured_emission(scene, &source, surface);
}

// Density (1/sr) with which sample_light, where the ray began, would have chosen the direction that hit area light
// `light_index` here.
static inline float light_pdf_w(const SurfaceView* scene, const Surface* surface, uint light_index, Ray ray)
{
    const Light light = scene->lights[light_index];
    const float3 origin = unpack(ray.origin);
    const float probability = light_probability(scene, light_index, origin, ray.horizon);
    const float3 to_light = surface->position - origin;
    if (light.type == LIGHT_SPHERE) {
        const AnalyticPrimitive primitive = scene->analytics[light.primitive & ~ANALYTIC_BIT];
        const float3 to_center = unpack(primitive.center) - origin;
        const float one_minus_cos = sphere_one_minus_cos(primitive.radius, dot(to_center, to_center));
        const bool flipped = (scene->shapes[primitive.shape].flags & SHAPE_FLIP_NORMALS) != 0u;
        if (one_minus_cos < 2.0f && !flipped) return probability / (2.0f * PI_F * one_minus_cos);
    }
    const float cos_at_light = fabs(dot(surface->outgoing, surface->geometric_normal));
    return pdf_w_from_a(probability / light.area, dot(to_light, to_light), fmax(cos_at_light, 1e-8f));
}

// How much likelier next-event estimation at `position` is to choose the point on a light (or the direction, of a distant light)
// from which a light subpath came there along `direction`, than the subpath was: p_connect / p_point. With the horizon 0.
static inline float connect_ratio(const SurfaceView* scene, uint light_index, float3 light_point, float3 position, float3 direction)
{
    const Light light = scene->lights[light_index];
    const float ratio = light_probability(scene, light_index, position, 0u) / light.probability;
    if (light.type != LIGHT_SPHERE) return ratio;
    const AnalyticPrimitive primitive = scene->analytics[light.primitive & ~ANALYTIC_BIT];
    const float3 center = unpack(primitive.center);
    const float3 to_center = center - position, to_light = light_point - position;
    const float one_minus_cos = sphere_one_minus_cos(primitive.radius, dot(to_center, to_center));
    if (!(one_minus_cos < 2.0f) || (scene->shapes[primitive.shape].flags & SHAPE_FLIP_NORMALS)) return ratio;
    const float cos_at_light = dot(light_point - center, direction) / primitive.radius;
    return ratio * light.area * cos_at_light / (2.0f * PI_F * one_minus_cos * dot(to_light, to_light));
}

// Radiance of the environment from a direction (unit, away from the scene), and the density (1/sr) with which
// sample_light would have chosen it. Both are zero without an environment.
static inline EnvironmentValue environment_value(const SurfaceView* scene, float3 direction)
{
    EnvironmentValue value = {(float3)(0.0f), 0.0f};
    const uint index = scene->globals->environment_light;
    if (index == NO_LIGHT) return value;
    const Light light = scene->lights[index];
    value.radiance = (float3)(1.0f);
    value.pdf_w = 0.25f * INV_PI_F;
#if LIGHT_OCCURS(LIGHT_ENVMAP)
    if (light.type == LIGHT_ENVMAP) {
        const EnvironmentMap map = scene->environment_maps[light.primitive];
        value = environment_map_value(scene, &map, direction);
    }
#endif
    value.radiance = transport_emission(scene, value.radiance * unpack(light.emission));
    value.pdf_w *= light_probability(scene, index, (float3)(0.0f), 0u); // the same from everywhere
    return value;
}

#endif
