// The hierarchy of lights that next-event estimation chooses from (kernels/shared/light_tree.h).
#pragma once

#include "scene/flat_scene.h"

namespace sundog {

// Builds the tree over a scene's lights, whose probabilities must be there: those that lie somewhere below splits that
// keep what is bright, small and alike in direction together [Conty Estevez and Kulla 2018, section 4.4]; each light
// from everywhere (directional, constant, envmap) beside all others, with a chance of its own for all points. Empty
// where it would hold fewer than two lights. Those without power, and collimated ones, which no point sees, are left out.
// The same scene gives the same tree.
std::vector<LightNode> build_light_tree(const FlatScene& flat);

// How next-event estimation chooses lights. automatic: by a tree from `lights_for_a_tree` lights on.
enum class LightSelection { automatic, tree, power };

// Measured: docs/lights.md.
constexpr std::size_t lights_for_a_tree = 4;

} // namespace sundog
