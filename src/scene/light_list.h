// The scene's lights as records, with the table that chooses among them.
#pragma once

#include "scene/flat_scene.h"

namespace sundog {

// Share of light samples and light paths that is dealt out evenly among emitters, whatever their power.
constexpr double emitter_floor = 0.1;

// Fills lights, light_alias, the shapes' first_light, and the lights' part of the globals; geometry and
// globals.radius must be there. Throws SceneError when no light has any power.
void list_lights(const Scene& scene, FlatScene& flat);

} // namespace sundog
