// Surfaces as the device sees them.
#ifndef SUNDOG_SHARED_GEOMETRY_H
#define SUNDOG_SHARED_GEOMETRY_H
#include "shared/vec3.h"
SHARED_BEGIN

// Counter-clockwise vertices seen from the side that the normal points to.
typedef struct Triangle {
    uint vertex[3];
    uint shape;
} Triangle;
SHARED_SIZE(Triangle, 16);

#define ANALYTIC_SPHERE 0u
#define ANALYTIC_DISK 1u
#define ANALYTIC_CYLINDER 2u

// Sphere: centre and radius. Disk (or ellipse): centre + a * axis_u + b * axis_v
// with a^2 + b^2 <= 1; normal is unit length. The normal of a sphere points
// outwards, unless its shape has SHAPE_FLIP_NORMALS; its axis_u, axis_v and normal
// are the unit axes x, y and z of its texture coordinates. Cylinder, open at both
// ends: from center to center + length * normal, all three axes of unit length;
// its normals as a sphere's.
typedef struct AnalyticPrimitive {
    Vec3 center;
    float radius;
    Vec3 axis_u;
    uint kind;
    Vec3 axis_v;
    uint shape;
    Vec3 normal;
    float length; // of a cylinder
} AnalyticPrimitive;
SHARED_SIZE(AnalyticPrimitive, 64);

#define SHAPE_HAS_NORMALS 1u  // interpolate `normals` at triangles
#define SHAPE_FLIP_NORMALS 2u // a sphere or cylinder whose normals point inwards
#define SHAPE_HAS_UVS 4u      // interpolate `uvs` at triangles

#define NO_LIGHT 0xffffffffu

// first_light: the light of the shape's first primitive (the following
// primitives' lights follow), or NO_LIGHT. first_primitive: index of that first
// primitive among `triangles` (or, for an analytic shape, among `analytics`).
typedef struct Shape {
    uint bsdf;
    uint first_light;
    uint first_primitive;
    uint flags;
} Shape;
SHARED_SIZE(Shape, 16);

// A copy of a group of shapes. Points: world = to_world * object + translation,
// object = to_object * (world - translation), so that what is lost in rounding goes
// with the distance from the instance. root: of the group's tree, as
// BvhNode::child; center and radius: of a sphere about the group, in its own space.
typedef struct Instance {
    Vec3 to_world[3]; // rows
    Vec3 translation;
    Vec3 to_object[3]; // rows of the inverse of to_world
    Vec3 center;
    float radius;
    int root;
    uint unused[2];
} Instance;
SHARED_SIZE(Instance, 112);

SHARED_END
#endif
