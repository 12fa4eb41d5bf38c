// Vectors apart into direction and length.
#pragma once

#include "math/vec3.h"

namespace sundog {

struct DirectionAndLength {
    Vec3 direction; // unit length
    float length;
};

// What is of unit length but for rounding stays as it is, bit for bit, with length 1: normalizing it again would only
// change the rounding, and a scene that is written and read again would not be quite the same.
inline DirectionAndLength direction_and_length(Vec3 v)
{
    constexpr double rounding = 1e-6; // of a squared length: a normalization's five roundings, of 2^-24 each, and room to spare
    const double squared = static_cast<double>(v.x) * v.x + static_cast<double>(v.y) * v.y + static_cast<double>(v.z) * v.z;
    if (std::abs(squared - 1.0) <= rounding) return {v, 1.0f};
    const double length = std::sqrt(squared);
    return {{static_cast<float>(v.x / length), static_cast<float>(v.y / length), static_cast<float>(v.z / length)}, static_cast<float>(length)};
}

inline Vec3 direction_of(Vec3 v) { return direction_and_length(v).direction; }

} // namespace sundog
