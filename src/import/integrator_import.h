// The integrator of a scene file: a method's name and its parameters as text.
#pragma once

#include "import/object_reader.h"
#include "scene/scene.h"

namespace sundog
{

// Keeps type and parameters for the method that will read them, names in snake_case. Integrators of Mitsuba that are a
// method here under another name become it (direct, volpath, ...). Parameters of Mitsuba's integrators become the
// equivalent one here, or are ignored with a warning where they do not change the image. Of nested integrators (aov,
// moment, ...) the first inside is taken, with a warning.
// scene_radius: of the bounding sphere of all shapes, of which Mitsuba 0.6's photon map takes lookup radii.
void import_integrator(const XmlElement& element, const SceneIndex& index, float scene_radius, IntegratorRequest& request);

// The integrator to render: the scene's only one that no other refers to. Nothing without one; throws SceneError for two.
std::optional<NestedObject> chosen_integrator(ObjectReader& root);

} // namespace sundog
