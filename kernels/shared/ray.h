// Rays and what they hit: the currency of the trace stages.
#ifndef SUNDOG_SHARED_RAY_H
#define SUNDOG_SHARED_RAY_H
#include "shared/vec3.h"
SHARED_BEGIN

// Points origin + t * direction with 0 < t < t_max. The direction need not be
// normalised: t is measured in its length.
typedef struct Ray {
    Vec3 origin;
    float t_max;
    Vec3 direction;
    uint horizon; // of the surface that it leaves (kernels/scene/horizon.h), where lights are chosen by a tree; RAY_FROM_LENS; else 0
} Ray;
SHARED_SIZE(Ray, 32);

// As a horizon, of programs built with HIDE_EMITTERS: the ray leads straight from the lens or to it, and sees no light. Its
// traversal starts below the root, at the first child, under which there is all but the lights.
#define RAY_FROM_LENS 1u

#define NO_PRIMITIVE 0xffffffffu
#define ANALYTIC_BIT 0x80000000u
#define NO_INSTANCE 0xffffffffu

// primitive: NO_PRIMITIVE for a miss; else an index into `triangles`, or, with
// ANALYTIC_BIT set, into `analytics`. u, v: for a triangle the barycentric
// weights of its second and third vertex; unused otherwise. instance: index into
// `instances`, or NO_INSTANCE for what lies in the world itself; only programs with
// HAS_INSTANCES write and read it.
typedef struct Hit {
    float t;
    float u;
    float v;
    uint primitive;
    uint instance;
} Hit;
SHARED_SIZE(Hit, 20);

SHARED_END
#endif
