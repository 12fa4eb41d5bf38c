// What a scene as a whole must have to be rendered.
#pragma once

#include "base/warning.h"
#include "scene/scene.h"

namespace sundog
{

// Throws SceneError when there is no shape, no light with any power, more than one environment, a light without area,
// what check_places() refuses, or more triangles than 32-bit indices can name. Lights of zero power are taken out, with a warning each.
void validate_scene(Scene& scene, std::vector<Warning>& warnings);

// Area of a shape's surface (scene units squared).
double surface_area(const ShapeDescription& shape);

} // namespace sundog
