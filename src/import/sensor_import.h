// The sensor of a scene file, with its film and sampler.
#pragma once

#include "import/object_reader.h"
#include "scene/scene.h"

namespace sundog
{

// Fills in scene.sensor, scene.film, and what the sampler says in scene.integrator.
// Throws SceneError for unsupported sensors, films and filters and for values out of range.
void import_sensor(const XmlElement& element, const SceneIndex& index, Scene& scene);

// Throws as import_sensor. `reader` is a <film>'s.
Film import_film(ObjectReader& reader);

// Tangent of half the horizontal field of view, from fov and fov_axis or focal_length; aspect is width over height.
double read_tan_half_x(ObjectReader& reader, double aspect);

} // namespace sundog
