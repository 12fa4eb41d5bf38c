// Primitives as the hierarchy's builder sees them: boxes, and what is left of a
// primitive inside a box.
#pragma once

#include "scene/bvh_build.h"

#include <cstdint>
#include <vector>

namespace sundog
{

// Box of one primitive. id: as Hit::primitive.
struct BvhPrimitive {
    Bounds bounds;
    uint id;
};

// All primitives that a ray can hit, in ascending order of id. Throws as build_bvh.
std::vector<BvhPrimitive> collect_primitives(const BvhGeometry& geometry);

// Bounds of the part of primitive `id` that lies inside `box`: for a triangle of the clipped polygon, for
// an analytic primitive the box itself. Never smaller than the exact part, never larger than the box.
Bounds clipped_bounds(const BvhGeometry& geometry, uint id, const Bounds& box);

} // namespace sundog
