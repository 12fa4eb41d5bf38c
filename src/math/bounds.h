// Axis-aligned bounds.
#pragma once

#include "math/vec3.h"

#include <limits>

namespace sundog {

struct Bounds {
    Vec3 lower{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()};
    Vec3 upper{-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};

    bool empty() const { return !(lower.x <= upper.x); }
    void extend(Vec3 p)
    {
        lower = min(lower, p);
        upper = max(upper, p);
    }
    void extend(const Bounds& b)
    {
        lower = min(lower, b.lower);
        upper = max(upper, b.upper);
    }
    Vec3 center() const { return (lower + upper) * 0.5f; }
    Vec3 extent() const { return upper - lower; }
    // Radius of the sphere about center() that holds the box.
    float radius() const { return 0.5f * length(extent()); }
};

} // namespace sundog
