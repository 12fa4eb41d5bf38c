// The surface at a hit: position, normals, and what lies there.
#ifndef SUNDOG_SURFACE_H
#define SUNDOG_SURFACE_H
#include "math/frame.h"
#include "math/vec3.h"
#include "scene/scene_view.h"
#ifdef HAS_INSTANCES
#include "scene/instance_space.h"
#endif

// -D HAS_UV=1 where something in the scene asks for texture coordinates: textures, anisotropy, bumps.
#ifndef HAS_UV
#define HAS_UV 1
#endif

typedef struct Surface {
    float3 position;
    float3 geometric_normal; // of the surface itself: where its front is
    float3 shading_normal;   // on the same side as the geometric one
    float3 outgoing;         // unit, back along the ray that came
    float offset;            // how far rays must start off the surface to leave it
    uint shape;
    uint primitive;
#if HAS_UV
    float2 uv;
    float2 barycentric; // of the triangle's second and third vertex
    float3 dpdu;        // how the position moves with u
    float3 dpdv;
#endif
} Surface;

// Rounding errors of a hit point are a few ulp of the coordinates it was computed from: offsets scale
// with those, so that scenes in millimetres and in kilometres behave alike.
#define OFFSET_PER_COORDINATE 4e-6f

static inline float max_abs(float3 v) { return max3(fabs(v)); }

#if HAS_UV
// Texture coordinates of a triangle, and how its plane moves with them. Without any in the mesh they are the
// barycentric weights, as in Mitsuba, and the tangents any frame.
static inline void triangle_uv(const SurfaceView* scene, const Triangle* triangle, Hit hit, float3 ab, float3 ac, Surface* surface)
{
    surface->barycentric = (float2)(hit.u, hit.v);
    const Frame any = make_frame(surface->geometric_normal);
    surface->dpdu = any.s;
    surface->dpdv = any.t;
    surface->uv = surface->barycentric;
    if (!(scene->shapes[triangle->shape].flags & SHAPE_HAS_UVS)) return;
    const Vec2 a = scene->uvs[triangle->vertex[0]], b = scene->uvs[triangle->vertex[1]], c = scene->uvs[triangle->vertex[2]];
    const float2 uv_a = (float2)(a.x, a.y);
    const float2 uv_ab = (float2)(b.x, b.y) - uv_a, uv_ac = (float2)(c.x, c.y) - uv_a;
    surface->uv = uv_a + uv_ab * hit.u + uv_ac * hit.v;
    const float determinant = uv_ab.x * uv_ac.y - uv_ab.y * uv_ac.x;
    if (determinant == 0.0f) return;
    surface->dpdu = (ab * uv_ac.y - ac * uv_ab.y) / determinant;
    surface->dpdv = (ac * uv_ab.x - ab * uv_ac.x) / determinant;
}

// Turn [0, 1) about z of a point of the plane.
static inline float turn_of(float x, float y)
{
    const float turn = atan2(y, x) * (0.5f / 3.14159265358979f);
    return turn < 0.0f ? turn + 1.0f : turn;
}

// Mitsuba's parametrisations. Sphere: (azimuth, polar angle) as fractions of 2 pi and pi; cylinder: (azimuth, height);
// disk: (radius, azimuth).
static inline void analytic_uv(const AnalyticPrimitive* primitive, Surface* surface)
{
    const float3 axis_u = unpack(primitive->axis_u), axis_v = unpack(primitive->axis_v), axis_n = unpack(primitive->normal);
    surface->barycentric = (float2)(0.0f);
    const float3 local_position = surface->position - unpack(primitive->center);
    if (primitive->kind == ANALYTIC_SPHERE) {
        const float3 outwards = local_position / primitive->radius;
        const float x = dot(outwards, axis_u), y = dot(outwards, axis_v), z = dot(outwards, axis_n);
        const float sine = sqrt(x * x + y * y);
        surface->uv = (float2)(turn_of(x, y), atan2(sine, z) * (1.0f / 3.14159265358979f));
        const float2 around = sine > 1e-6f ? (float2)(x, y) / sine : (float2)(1.0f, 0.0f);
        surface->dpdu = (axis_v * around.x - axis_u * around.y) * (2.0f * 3.14159265358979f * primitive->radius * fmax(sine, 1e-6f));
        surface->dpdv = ((axis_u * around.x + axis_v * around.y) * z - axis_n * sine) * (3.14159265358979f * primitive->radius);
        return;
    }
    if (primitive->kind == ANALYTIC_CYLINDER) {
        const float x = dot(local_position, axis_u), y = dot(local_position, axis_v);
        surface->uv = (float2)(turn_of(x, y), dot(local_position, axis_n) / primitive->length);
        surface->dpdu = (axis_v * x - axis_u * y) * (2.0f * 3.14159265358979f);
        surface->dpdv = axis_n * primitive->length;
        return;
    }
    const float x = dot(local_position, axis_u) / dot(axis_u, axis_u), y = dot(local_position, axis_v) / dot(axis_v, axis_v);
    const float radius = sqrt(x * x + y * y);
    surface->uv = (float2)(radius, turn_of(x, y));
    const float2 around = radius > 1e-6f ? (float2)(x, y) / radius : (float2)(1.0f, 0.0f);
    surface->dpdu = axis_u * around.x + axis_v * around.y;
    surface->dpdv = (axis_v * around.x - axis_u * around.y) * (2.0f * 3.14159265358979f * fmax(radius, 1e-6f));
}
#endif

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
#if HAS_UV
    triangle_uv(scene, &triangle, hit, b - a, c - a, surface);
#endif
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
#if HAS_UV
    analytic_uv(&primitive, surface);
#endif
}

#ifdef HAS_INSTANCES
// From the group's space into the world. The next ray starts at position +- offset * normal and is mapped back into the
// group's space, where it must be off the surface: the offset along the normal n shrinks to offset * |M^T n|, M being
// to_object, and must outdo the rounding of the primitive itself (the offset so far), of M times the distance from
// the instance's origin, and, in the world, of the position.
static inline void move_to_world(__global const Instance* instance, Surface* surface)
{
    const float3 coordinates = (float3)(surface->offset / OFFSET_PER_COORDINATE);
    const float3 from_origin = to_world_extent(instance, coordinates);
    const float3 translation = unpack(instance->translation);
    const float3 normal = to_world_normal(instance, surface->geometric_normal);
    const float inverse_length = 1.0f / length(normal);
    const float mapping_back = dot(fabs(surface->geometric_normal), to_object_extent(instance, from_origin));
    surface->offset = (surface->offset + OFFSET_PER_COORDINATE * mapping_back) * inverse_length +
                      OFFSET_PER_COORDINATE * max_abs(from_origin + fabs(translation));
    surface->position = to_world_vector(instance, surface->position) + translation;
    surface->geometric_normal = normal * inverse_length;
    surface->shading_normal = normalize(to_world_normal(instance, surface->shading_normal));
#if HAS_UV
    surface->dpdu = to_world_vector(instance, surface->dpdu);
    surface->dpdv = to_world_vector(instance, surface->dpdv);
#endif
}
#endif

static inline Surface surface_at(const SurfaceView* scene, Ray ray, Hit hit)
{
    Surface surface;
    surface.outgoing = -normalize(unpack(ray.direction));
    surface.primitive = hit.primitive;
#ifdef HAS_INSTANCES
    if (hit.instance != NO_INSTANCE) ray = ray_in_object_space(scene->instances + hit.instance, ray);
#endif
    if (hit.primitive & ANALYTIC_BIT) analytic_surface(scene, hit, unpack(ray.origin) + hit.t * unpack(ray.direction), &surface);
    else triangle_surface(scene, hit, &surface);
#ifdef HAS_INSTANCES
    if (hit.instance != NO_INSTANCE) move_to_world(scene->instances + hit.instance, &surface);
#endif
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
    ray.horizon = 0u;
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
