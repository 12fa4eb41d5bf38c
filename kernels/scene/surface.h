// The surface at a hit: position, normals, and what lies there.
#ifndef SUNDOG_SURFACE_H
#define SUNDOG_SURFACE_H
#include "math/vec3.h"
#include "scene/scene_view.h"

typedef struct Surface {
    float3 position;
    float3 geometric_normal; // of the surface itself: where its front is
    float3 shading_normal;   // on the same side as the geometric one
    float3 outgoing;         // unit, back along the ray that came
    float offset;            // how far rays must start off the surface to leave it
    uint shape;
    uint primitive;
} Surface;

// Rounding errors of a hit point are a few ulp of the coordinates it was computed from: offsets scale
// with those, so that scenes in millimetres and in kilometres behave alike.
#define OFFSET_PER_COORDINATE 4e-6f

static inline float max_abs(float3 v) { return max3(fabs(v)); }

static inline void triangle_surface(const SurfaceView* scene, Hit hit, Surface* surface)
{
    const Triangle triangle = scene->triangles[hit.primitive];
    const float3 a = unpack(scene->positions[triangle.vertex[0]]);
    const float3 b = unpack(scene->positions[triangle.vertex[1]]);
    const float3 c = unpack(scene->positions[triangle.vertex[2]]);
    // Interpolated rather than origin + t * direction: accurate however far the ray came.
    const float w = 1.0f - hit.u - hit.v;
    surface->position = a * w + b * hit.u + c * hit.v;
    surface->offset = OFFSET_PER_COORDINATE * fmax(max_abs(a), fmax(max_abs(b), max_abs(c)));
    surface->geometric_normal = normalize(cross(b - a, c - a));
    surface->shading_normal = surface->geometric_normal;
    surface->shape = triangle.shape;
    if (scene->shapes[triangle.shape].flags & SHAPE_HAS_NORMALS) {
        const float3 n = unpack(scene->normals[triangle.vertex[0]]) * w + unpack(scene->normals[triangle.vertex[1]]) * hit.u +
                         unpack(scene->normals[triangle.vertex[2]]) * hit.v;
        const float length_squared = dot(n, n);
        if (length_squared > 1e-12f) surface->shading_normal = n * rsqrt(length_squared);
    }
}

static inline void analytic_surface(const SurfaceView* scene, Hit hit, float3 point, Surface* surface)
{
    const AnalyticPrimitive primitive = scene->analytics[hit.primitive & ~ANALYTIC_BIT];
    const float3 center = unpack(primitive.center);
    if (primitive.kind == ANALYTIC_SPHERE) {
        const float3 outwards = normalize(point - center);
        surface->position = center + outwards * primitive.radius; // back onto the sphere
        surface->geometric_normal = (scene->shapes[primitive.shape].flags & SHAPE_FLIP_NORMALS) ? -outwards : outwards;
        surface->offset = OFFSET_PER_COORDINATE * (max_abs(center) + primitive.radius);
    } else if (primitive.kind == ANALYTIC_CYLINDER) {
        const float3 axis = unpack(primitive.normal);
        const float height = dot(point - center, axis);
        const float3 outwards = normalize(point - center - axis * height);
        surface->position = center + axis * clamp(height, 0.0f, primitive.length) + outwards * primitive.radius;
        surface->geometric_normal = (scene->shapes[primitive.shape].flags & SHAPE_FLIP_NORMALS) ? -outwards : outwards;
        surface->offset = OFFSET_PER_COORDINATE * (max_abs(center) + primitive.radius + primitive.length);
    } else {
        const float3 normal = unpack(primitive.normal);
        surface->position = point - normal * dot(point - center, normal);
        surface->geometric_normal = normal;
        surface->offset = OFFSET_PER_COORDINATE * (max_abs(center) + max_abs(unpack(primitive.axis_u)) + max_abs(unpack(primitive.axis_v)));
    }
    surface->shading_normal = surface->geometric_normal;
    surface->shape = primitive.shape;
}

static inline Surface surface_at(const SurfaceView* scene, Ray ray, Hit hit)
{
    const float3 direction = unpack(ray.direction);
    Surface surface;
    surface.outgoing = -normalize(direction);
    surface.primitive = hit.primitive;
    if (hit.primitive & ANALYTIC_BIT) analytic_surface(scene, hit, unpack(ray.origin) + hit.t * direction, &surface);
    else triangle_surface(scene, hit, &surface);
    // A shading normal that faces away from a ray that its own face does see would turn light through
    // the surface (black rims, leaks): such a hit is shaded flat.
    if (dot(surface.shading_normal, surface.outgoing) * dot(surface.geometric_normal, surface.outgoing) <= 0.0f)
        surface.shading_normal = surface.geometric_normal;
    return surface;
}

// Where a ray in `direction` starts, on the right side of the surface.
static inline float3 ray_origin(const Surface* surface, float3 direction)
{
    const float side = dot(surface->geometric_normal, direction) < 0.0f ? -surface->offset : surface->offset;
    return surface->position + surface->geometric_normal * side;
}

static inline Ray ray_from(const Surface* surface, float3 direction)
{
    Ray ray;
    ray.origin = pack(ray_origin(surface, direction));
    ray.direction = pack(direction);
    ray.t_max = INFINITY;
    ray.unused = 0u;
    return ray;
}

// A ray that no trace stage follows.
static inline Ray no_ray(void)
{
    Ray ray = {{0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, 0u};
    return ray;
}

// The normal on the side that `direction` points to.
static inline float3 facing(float3 normal, float3 direction) { return dot(normal, direction) < 0.0f ? -normal : normal; }

#endif
