// Light sources: choosing one, sampling points as seen from a surface, and densities for MIS.
#ifndef SUNDOG_SCENE_LIGHTS_H
#define SUNDOG_SCENE_LIGHTS_H
#include "math/frame.h"
#include "math/warp.h"
#include "scene/spectral.h"
#include "scene/surface.h"
#include "shared/path.h"

// A light as a shaded point sees it.
typedef struct LightSample {
    float3 direction; // unit, towards the light
    Ray shadow_ray;   // from the surface's offset origin to just before the light
    float3 radiance;  // arriving radiance over pdf_w: times f |cos| it is the estimate
    float pdf_w;      // 1/sr, the light's choice included; PDF_DELTA for point-like lights
} LightSample;

// Chooses a light by power with the alias table.
static inline uint choose_light(const SurfaceView* scene, float u)
{
    const uint count = scene->globals->light_count;
    const float scaled = u * (float)count;
    const uint column = min((uint)scaled, count - 1u);
    const AliasEntry entry = scene->light_alias[column];
    return scaled - (float)column < entry.threshold ? column : entry.alias;
}

// A point on an area light, uniform in area.
typedef struct LightPoint {
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

// Fall-off of a spot at `angle` from its axis: linear between beam width and cut-off, as in Mitsuba.
static inline float spot_falloff(const Light* light, float cos_angle)
{
    const float angle = acos(clamp(cos_angle, -1.0f, 1.0f));
    if (angle >= light->cutoff_angle) return 0.0f;
    return angle <= light->beam_width ? 1.0f : (light->cutoff_angle - angle) / (light->cutoff_angle - light->beam_width);
}

static inline Ray segment(float3 from, float3 to)
{
    Ray ray;
    ray.origin = pack(from);
    ray.direction = pack(to - from);
    ray.t_max = 1.0f;
    ray.unused = 0u;
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

static inline bool sample_area_light(const SurfaceView* scene, const Surface* surface, const Light* light, float2 u, LightSample* sample)
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
            sample->pdf_w = light->probability / (2.0f * PI_F * one_minus_cos);
            sample->shadow_ray = segment_to(surface, direction, &point);
            sample->radiance = transport_emission(scene, unpack(light->emission)) / sample->pdf_w;
            return true;
        }
    }
    point = sample_light_point(scene, light, u);
    const float3 to_light = point.position - surface->position;
    const float distance_squared = dot(to_light, to_light);
    sample->direction = to_light * rsqrt(distance_squared);
    const float cos_at_light = -dot(sample->direction, point.normal);
    if (!(cos_at_light > 0.0f) || !(distance_squared > 0.0f)) return false;
    sample->pdf_w = pdf_w_from_a(light->probability / light->area, distance_squared, cos_at_light);
    sample->radiance = transport_emission(scene, unpack(light->emission)) / sample->pdf_w;
    sample->shadow_ray = segment_to(surface, sample->direction, &point);
    return true;
}

// Samples the lights as seen from a surface. False: no light that way.
static inline bool sample_light(const SurfaceView* scene, const Surface* surface, float4 u, LightSample* sample)
{
    const Light light = scene->lights[choose_light(scene, u.z)];
    switch (light.type) {
    case LIGHT_POINT:
    case LIGHT_SPOT: {
        const float3 to_light = unpack(light.position) - surface->position;
        const float distance_squared = dot(to_light, to_light);
        sample->direction = to_light * rsqrt(distance_squared);
        float3 intensity = transport_emission(scene, unpack(light.emission));
        if (light.type == LIGHT_SPOT) intensity *= spot_falloff(&light, -dot(sample->direction, unpack(light.direction)));
        sample->radiance = intensity / (distance_squared * light.probability);
        sample->pdf_w = PDF_DELTA;
        sample->shadow_ray = segment(ray_origin(surface, sample->direction), unpack(light.position));
        return distance_squared > 0.0f && !is_black(intensity);
    }
    case LIGHT_DIRECTIONAL:
        sample->direction = -unpack(light.direction);
        sample->radiance = transport_emission(scene, unpack(light.emission)) / light.probability;
        sample->pdf_w = PDF_DELTA;
        sample->shadow_ray = ray_from(surface, sample->direction);
        return true;
    case LIGHT_CONSTANT:
        sample->direction = sample_sphere(u.xy);
        sample->pdf_w = light.probability * (0.25f * INV_PI_F);
        sample->radiance = transport_emission(scene, unpack(light.emission)) / sample->pdf_w;
        sample->shadow_ray = ray_from(surface, sample->direction);
        return true;
    default: return sample_area_light(scene, surface, &light, u.xy, sample);
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
    return light != NO_LIGHT && front ? transport_emission(scene, unpack(scene->lights[light].emission)) : (float3)(0.0f);
}

// Density (1/sr) with which sample_light, at the ray's origin, would have chosen the direction that hit
// area light `light` here, `distance` away.
static inline float light_pdf_w(const SurfaceView* scene, const Surface* surface, uint light_index, float3 origin)
{
    const Light light = scene->lights[light_index];
    const float3 to_light = surface->position - origin;
    if (light.type == LIGHT_SPHERE) {
        const AnalyticPrimitive primitive = scene->analytics[light.primitive & ~ANALYTIC_BIT];
        const float3 to_center = unpack(primitive.center) - origin;
        const float one_minus_cos = sphere_one_minus_cos(primitive.radius, dot(to_center, to_center));
        const bool flipped = (scene->shapes[primitive.shape].flags & SHAPE_FLIP_NORMALS) != 0u;
        if (one_minus_cos < 2.0f && !flipped) return light.probability / (2.0f * PI_F * one_minus_cos);
    }
    const float cos_at_light = fabs(dot(surface->outgoing, surface->geometric_normal));
    return pdf_w_from_a(light.probability / light.area, dot(to_light, to_light), fmax(cos_at_light, 1e-8f));
}

// The same for the constant environment.
static inline float constant_light_pdf_w(const SurfaceView* scene)
{
    return scene->lights[scene->globals->constant_light].probability * (0.25f * INV_PI_F);
}

#endif
