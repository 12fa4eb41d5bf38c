// What single precision can hold of a scene's places and sizes.
#pragma once

#include "scene/scene.h"

namespace sundog
{

// Throws SceneError, at the line of the shape, instance, light or sensor, for a coordinate beyond 1e12, a shape smaller than
// 1e-12, a mesh of which no triangle has an area in single precision, and a mesh attribute that a texture shows and that is
// not finite.
void check_places(const Scene& scene);

} // namespace sundog
