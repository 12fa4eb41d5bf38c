// Primitives as the hierarchy's builder sees them: boxes, and what is left of a
// primitive inside a box.
#pragma once

#include "scene/bvh_build.h"

#include <cstdint>
#include <vector>

namespace sundog
{

// Box of one primitive or instance. id: as Hit::primitive, or the index of the instance.
struct BvhPrimitive {
    Bounds bounds;
    uint id;
};

// All primitives that a ray can hit, in ascending order of id. Throws as build_bvh.
std::vector<BvhPrimitive> collect_primitives(const BvhGeometry& geometry);

// Bounds of the parts of primitive `id` on both sides of the plane x[axis] = position, within `box` (which
// the plane cuts): for a triangle of the two polygons, for an analytic primitive the halves of the box.
// Never smaller than the exact parts.
struct SplitBounds {
    Bounds below, above;
};
SplitBounds split_bounds(const BvhGeometry& geometry, uint id, const Bounds& box, int axis, float position);

} // namespace sundog
