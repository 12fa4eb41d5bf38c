// Bounds of what a file may bring as radiance or flux.
#pragma once

#include "math/vec3.h"

#include <algorithm>
#include <cmath>

namespace sundog
{

// No render adds up to more, and products with weights and factors stay within a float.
constexpr float largest_plausible = 1e36f;

inline bool is_plausible(Vec3 v, float largest = largest_plausible)
{
    return is_finite(v) && std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= largest;
}

} // namespace sundog
