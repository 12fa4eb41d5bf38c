// The surface at a hit, in double precision.
#pragma once

#include "scene/flat_scene.h"
#include "shared/ray.h"
#include "support/double3.h"
#include "support/plain_doubt.h"

#include <limits>

namespace sundog
{

struct PlainRay {
    Vec3d origin, direction;
    double t_max = std::numeric_limits<double>::infinity();
};

// Rays start off the surface by this share of the largest coordinate that its points are computed from.
constexpr double offset_per_coordinate = 4e-6;

// A scene as described, with the device's numbering of its primitives and lights.
struct PlainScene {
    Scene scene;
    FlatScene flat;
    Camera camera;
    PixelFilter filter;

    PlainScene() = default;
    explicit PlainScene(Scene description)
        : scene(std::move(description)), flat(flatten_scene(scene)), camera(make_camera(scene.sensor, scene.film)),
          filter(make_pixel_filter(scene.film.filter))
    {
    }
};

inline double largest_coordinate(Vec3d v)
{
    return std::fmax(std::abs(v.x), std::fmax(std::abs(v.y), std::abs(v.z)));
}

struct PlainSurface {
    Vec3d position;
    Vec3d geometric_normal; // where the front is
    Vec3d shading_normal;
    Vec3d outgoing; // unit, back along the ray
    double offset;
    uint shape;
    uint primitive;

    bool front() const { return dot(outgoing, geometric_normal) > 0.0; }
    Vec3d normal_seen() const { return front() ? geometric_normal : -geometric_normal; }

    // A ray leaves on the side that it points to.
    Vec3d ray_origin(Vec3d direction) const
    {
        return position + geometric_normal * std::copysign(offset, dot(direction, geometric_normal));
    }
    PlainRay ray(Vec3d direction) const { return {ray_origin(direction), direction}; }
};

// A triangle's corners, its normal by the right-hand rule, and its offset.
struct PlainTriangle {
    Vec3d a, b, c, normal;
    double offset;

    PlainTriangle(const FlatScene& flat, uint index)
    {
        const auto& vertex = flat.triangles.at(index).vertex;
        a = flat.positions[vertex[0]], b = flat.positions[vertex[1]], c = flat.positions[vertex[2]];
        normal = normalized(cross(b - a, c - b));
        offset = offset_per_coordinate * std::fmax(largest_coordinate(a), std::fmax(largest_coordinate(b), largest_coordinate(c)));
    }
};

inline double offset_of(const AnalyticPrimitive& primitive)
{
    const double extent = primitive.kind == ANALYTIC_SPHERE ? double(primitive.radius)
                                                            : largest_coordinate(primitive.axis_u) + largest_coordinate(primitive.axis_v);
    return offset_per_coordinate * (largest_coordinate(primitive.center) + extent);
}

inline bool is_flipped(const FlatScene& flat, const AnalyticPrimitive& primitive)
{
    return (flat.shapes[primitive.shape].flags & SHAPE_FLIP_NORMALS) != 0;
}

inline void place_on_triangle(const FlatScene& flat, const Hit& hit, PlainSurface& surface)
{
    const Triangle& record = flat.triangles.at(hit.primitive);
    const PlainTriangle triangle(flat, hit.primitive);
    const double u = hit.u, v = hit.v;
    surface.position = triangle.a + (triangle.b - triangle.a) * u + (triangle.c - triangle.a) * v;
    surface.geometric_normal = surface.shading_normal = triangle.normal;
    surface.offset = triangle.offset;
    surface.shape = record.shape;
    if (flat.shapes[record.shape].flags & SHAPE_HAS_NORMALS) {
        const auto normal = [&](int corner) { return Vec3d(flat.normals[record.vertex[corner]]); };
        surface.shading_normal = normalized(normal(0) * (1.0 - u - v) + normal(1) * u + normal(2) * v);
    }
}

inline void place_on_analytic(const FlatScene& flat, const Ray& ray, const Hit& hit, PlainSurface& surface)
{
    const AnalyticPrimitive& primitive = flat.analytics.at(hit.primitive - ANALYTIC_BIT);
    const Vec3d center = primitive.center, along = Vec3d(ray.origin) + Vec3d(ray.direction) * double(hit.t) - center;
    if (primitive.kind == ANALYTIC_SPHERE) {
        const Vec3d outwards = normalized(along);
        surface.position = center + outwards * double(primitive.radius);
        surface.geometric_normal = is_flipped(flat, primitive) ? -outwards : outwards;
    } else {
        const Vec3d normal = primitive.normal;
        surface.position = center + along - normal * dot(along, normal);
        surface.geometric_normal = normal;
    }
    surface.shading_normal = surface.geometric_normal;
    surface.offset = offset_of(primitive);
    surface.shape = primitive.shape;
}

inline PlainSurface plain_surface(const FlatScene& flat, const Ray& ray, const Hit& hit, Doubt& doubt)
{
    PlainSurface surface{};
    surface.primitive = hit.primitive;
    surface.outgoing = normalized(-Vec3d(ray.direction));
    if (hit.primitive >= ANALYTIC_BIT)
        place_on_analytic(flat, ray, hit, surface);
    else
        place_on_triangle(flat, hit, surface);
    // An interpolated normal that shows the other side than the face does is not used.
    const bool front = doubt.positive(dot(surface.outgoing, surface.geometric_normal));
    if (doubt.positive(dot(surface.outgoing, surface.shading_normal)) != front) surface.shading_normal = surface.geometric_normal;
    return surface;
}

} // namespace sundog
