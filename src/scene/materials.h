// Optical constants of named materials.
#pragma once

#include "math/vec3.h"

#include <optional>
#include <string>
#include <string_view>

namespace sundog
{

// Index of refraction at 589 nm of a named dielectric (case does not matter), values and names as in Mitsuba,
// after [Hecht 2002, Optics]. Nothing for an unknown name.
std::optional<float> find_ior(std::string_view name);

// Complex index of refraction eta + i k for red, green and blue.
struct ConductorConstants {
    Vec3 eta;
    Vec3 k;
};

// By chemical symbol as in Mitsuba ("Au", "Cu_palik"), or "none" for a perfect mirror. Nothing for an unknown name.
std::optional<ConductorConstants> find_conductor(std::string_view name);

// All names, separated by ", ", for messages.
std::string ior_names();
std::string conductor_names();

} // namespace sundog
