// Triples in double precision, for host arithmetic that must not lose what floats hold.
#pragma once

#include "math/vec3.h"

#include <array>

namespace sundog
{

using Double3 = std::array<double, 3>;

inline Double3 difference(Vec3 a, Vec3 b)
{
    return {static_cast<double>(a.x) - b.x, static_cast<double>(a.y) - b.y, static_cast<double>(a.z) - b.z};
}

inline Double3 difference(const Double3& a, const Double3& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Double3 cross(const Double3& a, const Double3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double dot(const Double3& a, const Double3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

} // namespace sundog
