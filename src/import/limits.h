// How large and small numbers of a scene may be, so that what is computed with them in 32 bits stays finite: squares and
// quotients of two lengths, and the fourth powers in Fresnel's equations.
#pragma once

#include "import/object_reader.h"

namespace sundog
{

constexpr double largest_coordinate = 1e12;      // of what has a place, as the hierarchy's
constexpr double largest_emission = 1e18;        // radiance, intensity, irradiance or power; squared by estimates of errors
constexpr double largest_relative_index = 100.0; // of dielectrics; its inverse is the least
constexpr double largest_complex_index = 1e8;    // eta and k of conductors
constexpr double narrowest_tangent = 1e-7, widest_tangent = 2e7; // of half a field of view

// Each throws SceneError, saying what is allowed.
void check_position(Vec3 position, const SourceLocation& where, const std::string& what);
void check_relative_index(float eta, const SourceLocation& where);
void check_emission(Vec3 emission, const SourceLocation& where, const std::string& name);

} // namespace sundog
