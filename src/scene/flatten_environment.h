// What surrounds the scene, as the device's arrays.
#pragma once

#include "scene/flat_scene.h"

#include <numbers>

namespace sundog {

// The image of a disk of directions, which is added to what is behind it.
struct SunDisk {
    Vec3 direction; // towards its middle, unit length
    Vec3 tangent;   // along which columns grow; rows grow along direction x tangent
    float one_minus_cos = 0.0f; // of the angle between its middle and its rim
    std::shared_ptr<const TexelImage> image; // float32, of the square around it
    double mean_luminance = 0.0; // over its disk
};

struct Surroundings {
    EnvironmentEmitter dome;
    double polar_range = std::numbers::pi; // of its rows
    std::optional<SunDisk> sun = std::nullopt; // never scaled
};

// Mean luminance over all directions (W/m^2/sr); of an environment emitter without its scale.
double mean_luminance(const EnvironmentEmitter& environment);
double mean_luminance(const Surroundings& surroundings);

// Appends the map, its texels and the alias table of its patches; gives the map's index. Something must be brighter
// than 0. Throws SceneError at `where` when texels are too many for 32-bit indices.
uint append_environment(const Surroundings& surroundings, const SourceLocation& where, FlatScene& flat);

} // namespace sundog
