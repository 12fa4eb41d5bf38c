// Environment maps as the device's arrays.
#pragma once

#include "scene/flat_scene.h"

namespace sundog {

// Mean luminance over all directions (W/m^2/sr), without the emitter's scale.
double mean_luminance(const EnvironmentEmitter& environment);

// Appends the map, its texels and the alias table of its patches; gives the map's index. Some texel must be brighter
// than 0. Throws SceneError at `where` when texels are too many for 32-bit indices.
uint append_environment(const EnvironmentEmitter& environment, const SourceLocation& where, FlatScene& flat);

} // namespace sundog
