// Light sources in double precision: choosing one, light arriving at a point, densities, and light setting out.
#pragma once

#include "support/plain_bsdf.h"

namespace sundog
{

// One of n equal columns, then the column's own light or the one that fills it up [Vose 1991].
inline const Light& plain_light_choice(const FlatScene& flat, double u, Doubt& doubt)
{
    const double scaled = u * static_cast<double>(flat.lights.size());
    const double column = std::floor(scaled), within = scaled - column;
    doubt.less(0.0, within);
    doubt.less(within, 1.0);
    const AliasEntry& entry = flat.light_alias.at(static_cast<std::size_t>(column));
    return flat.lights[doubt.less(within, entry.threshold) ? static_cast<std::size_t>(column) : entry.alias];
}

struct PlainLightPoint {
    Vec3d position;
    Vec3d normal;
    double offset;
    Vec3d off_surface(double further = 0.0) const { return position + normal * (offset + further); }
};

// Uniform in area.
inline PlainLightPoint plain_light_point(const FlatScene& flat, const Light& light, Pair u)
{
    if (light.type == LIGHT_TRIANGLE) {
        const PlainTriangle triangle(flat, light.primitive);
        const Pair weights = plain_triangle(u);
        return {triangle.a * (1.0 - weights[0] - weights[1]) + triangle.b * weights[0] + triangle.c * weights[1], triangle.normal,
                triangle.offset};
    }
    const AnalyticPrimitive& primitive = flat.analytics.at(light.primitive - ANALYTIC_BIT);
    const Vec3d center = primitive.center;
    if (light.type == LIGHT_DISK) {
        const Pair d = plain_disk(u);
        return {center + Vec3d(primitive.axis_u) * d[0] + Vec3d(primitive.axis_v) * d[1], primitive.normal, offset_of(primitive)};
    }
    const Vec3d outwards = plain_sphere(u);
    return {center + outwards * double(primitive.radius), is_flipped(flat, primitive) ? -outwards : outwards, offset_of(primitive)};
}

// 1 - cos of the half angle that a luminous sphere subtends; nothing for one that is seen from within or glows inwards.
inline std::optional<double> sphere_cone(const FlatScene& flat, const Light& light, Vec3d from, Doubt& doubt)
{
    if (light.type != LIGHT_SPHERE) return {};
    const AnalyticPrimitive& sphere = flat.analytics.at(light.primitive - ANALYTIC_BIT);
    const double sine = double(sphere.radius) / length(Vec3d(sphere.center) - from);
    if (is_flipped(flat, sphere) || !doubt.less(sine, 1.0)) return {};
    return 1.0 - std::cos(std::asin(sine));
}

// Linear in the angle between beam width and cut-off.
inline double plain_spot_falloff(const Light& light, double cosine, Doubt& doubt)
{
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)), cutoff = light.cutoff_angle, beam = light.beam_width;
    if (!doubt.less(angle, cutoff)) return 0.0;
    const double falloff = std::min(1.0, (cutoff - angle) / (cutoff - beam));
    doubt.rests_on(falloff, 0.01);
    return falloff;
}

// Light that arrives at a surface, if nothing is in between.
struct PlainArrival {
    Vec3d direction; // unit, towards the light
    Vec3d radiance;  // over pdf_w; of point-like lights what stands for it: irradiance across the direction
    double pdf_w;    // 0 for point-like lights
    PlainRay shadow_ray;
    uint type;
    // Density of light subpaths at the surface, 1/m^2 across the direction, that start at the point (or in the direction) chosen.
    double emitted_pdf_a;
};

// Of light subpaths that come from one direction: over the disk that faces the bounding sphere.
inline double plain_distant_pdf_a(const SceneGlobals& globals)
{
    return 1.0 / (pi * double(globals.radius) * double(globals.radius));
}

inline PlainRay segment_between(Vec3d from, Vec3d to)
{
    return {from, to - from, 1.0};
}

inline std::optional<PlainArrival> arrival_from_area(const FlatScene& flat, const Light& light, const PlainSurface& surface, Pair u,
                                                     Doubt& doubt)
{
    const double probability = light.probability;
    PlainLightPoint point{};
    double pdf_w;
    Vec3d direction;
    if (const auto cone = sphere_cone(flat, light, surface.position, doubt)) {
        // Uniform in the cone; the point is the nearer solution of |position + t direction - centre| = radius.
        const AnalyticPrimitive& sphere = flat.analytics.at(light.primitive - ANALYTIC_BIT);
        const Vec3d to_center = Vec3d(sphere.center) - surface.position;
        const double radius = sphere.radius;
        direction = PlainFrame(normalized(to_center), doubt).to_world(plain_cone(u, *cone));
        const double b = dot(direction, to_center), discriminant = b * b - dot(to_center, to_center) + radius * radius;
        doubt.rests_on(discriminant, 1e-2 * radius * radius); // its rim
        point.position = surface.position + direction * (b - std::sqrt(std::max(0.0, discriminant)));
        point.normal = normalized(point.position - Vec3d(sphere.center));
        point.offset = offset_of(sphere);
        pdf_w = probability / (2.0 * pi * *cone);
    } else {
        point = plain_light_point(flat, light, u);
        const Vec3d way = point.position - surface.position;
        direction = normalized(way);
        const double cos_at_light = -dot(direction, point.normal);
        if (!doubt.positive(cos_at_light)) return {};
        doubt.rests_on(cos_at_light, 1e-3);
        doubt.rests_on(length(way), 1e-3);
        pdf_w = probability / double(light.area) * dot(way, way) / cos_at_light;
    }
    const PlainRay shadow_ray = segment_between(surface.ray_origin(direction), point.off_surface(surface.offset));
    // p_point cos / pi / d^2 over p_point = pdf_w cos / d^2, which for a cone is not the density of the light subpath's point.
    return PlainArrival{direction, Vec3d(light.emission) / pdf_w, pdf_w, shadow_ray, light.type, probability / (double(light.area) * pi * pdf_w)};
}

inline std::optional<PlainArrival> plain_arrival(const FlatScene& flat, const PlainSurface& surface, const LightNumbers& u, Doubt& doubt)
{
    const Light& light = plain_light_choice(flat, u.choice, doubt);
    const double probability = light.probability;
    const Vec3d emission = light.emission;
    switch (light.type) {
    case LIGHT_POINT:
    case LIGHT_SPOT: {
        const Vec3d way = Vec3d(light.position) - surface.position, direction = normalized(way);
        const double falloff = light.type == LIGHT_SPOT ? plain_spot_falloff(light, -dot(direction, light.direction), doubt) : 1.0;
        if (falloff == 0.0) return {};
        const double emitted = light.type == LIGHT_SPOT ? 2.0 * pi * (1.0 - std::cos(double(light.cutoff_angle))) : 4.0 * pi; // sr
        return PlainArrival{direction, emission * (falloff / (dot(way, way) * probability)), 0.0,
                            segment_between(surface.ray_origin(direction), light.position), light.type, 1.0 / (emitted * dot(way, way))};
    }
    case LIGHT_DIRECTIONAL: {
        const Vec3d direction = -Vec3d(light.direction);
        return PlainArrival{direction, emission / probability, 0.0, surface.ray(direction), light.type, plain_distant_pdf_a(flat.globals)};
    }
    case LIGHT_CONSTANT: {
        const Vec3d direction = plain_sphere(u.position);
        const double pdf_w = probability / (4.0 * pi);
        return PlainArrival{direction, emission / pdf_w, pdf_w, surface.ray(direction), light.type, plain_distant_pdf_a(flat.globals)};
    }
    default:
        return arrival_from_area(flat, light, surface, u.position, doubt);
    }
}

// The area light that a hit surface is, lit from its front; or nothing.
inline const Light* plain_light_at(const PlainScene& scene, const PlainSurface& surface)
{
    if (!surface.front()) return nullptr;
    for (const Light& light : scene.flat.lights)
        if (light.type <= LIGHT_DISK && light.primitive == surface.primitive) return &light;
    return nullptr;
}

inline const Light* plain_environment(const PlainScene& scene)
{
    for (const Light& light : scene.flat.lights)
        if (light.type == LIGHT_CONSTANT) return &light;
    return nullptr;
}

// Density (1/sr) with which plain_arrival at `from` would have chosen the direction to the area light hit.
inline double plain_light_pdf_w(const FlatScene& flat, const Light& light, const PlainSurface& surface, Vec3d from, Doubt& doubt)
{
    if (const auto cone = sphere_cone(flat, light, from, doubt)) return double(light.probability) / (2.0 * pi * *cone);
    const double distance = length(surface.position - from), cos_at_light = std::abs(dot(surface.outgoing, surface.geometric_normal));
    doubt.rests_on(cos_at_light, 1e-3);
    doubt.rests_on(distance, 1e-3);
    return double(light.probability) / double(light.area) * distance * distance / cos_at_light;
}

// Light that sets out.
struct PlainEmission {
    PlainRay ray;
    Vec3d flux; // W, over the probability of the light
    uint type;
};

// From the disk that faces the bounding sphere.
inline PlainRay plain_distant_ray(const SceneGlobals& globals, Vec3d direction, Pair u, Doubt& doubt)
{
    const PlainFrame frame(direction, doubt);
    const Pair d = plain_disk(u);
    return {Vec3d(globals.center) + (frame.s * d[0] + frame.t * d[1] - direction) * double(globals.radius), direction};
}

// Flux is emission over the densities of position and direction: the whole of what the light sends (to the scene).
inline PlainEmission plain_emission(const FlatScene& flat, const EmissionNumbers& u, Doubt& doubt)
{
    const Light& light = plain_light_choice(flat, u.light.choice, doubt);
    const Vec3d emission = Vec3d(light.emission) / double(light.probability);
    const double disk = pi * double(flat.globals.radius) * double(flat.globals.radius);
    switch (light.type) {
    case LIGHT_POINT:
        return {{light.position, plain_sphere(u.direction)}, emission * (4.0 * pi), light.type};
    case LIGHT_SPOT: {
        const double cone = 1.0 - std::cos(double(light.cutoff_angle));
        const Vec3d local = plain_cone(u.direction, cone);
        const double falloff = plain_spot_falloff(light, local.z, doubt);
        return {{light.position, PlainFrame(light.direction, doubt).to_world(local)}, emission * (falloff * 2.0 * pi * cone), light.type};
    }
    case LIGHT_DIRECTIONAL:
        return {plain_distant_ray(flat.globals, light.direction, u.light.position, doubt), emission * disk, light.type};
    case LIGHT_CONSTANT:
        return {plain_distant_ray(flat.globals, plain_sphere(u.direction), u.light.position, doubt), emission * (4.0 * pi * disk),
                light.type};
    default: {
        const PlainLightPoint point = plain_light_point(flat, light, u.light.position);
        const Vec3d direction = PlainFrame(point.normal, doubt).to_world(plain_cosine_hemisphere(u.direction, doubt));
        return {{point.off_surface(), direction}, emission * (pi * double(light.area)), light.type};
    }
    }
}

} // namespace sundog
