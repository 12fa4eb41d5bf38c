// The integrator of a scene file: a method's name and its parameters as text.
#pragma once

#include "import/object_reader.h"
#include "scene/scene.h"

namespace sundog
{

// Keeps type and parameters for the method that will read them, names in snake_case and those of Mitsuba 0.6's
// photon mappers translated (photonCount -> photons, initialRadius -> radius, maxPasses -> iterations). Of nested
// integrators (aov, moment, ...) the first inside is taken, with a warning.
void import_integrator(const XmlElement& element, const SceneIndex& index, IntegratorRequest& request);

} // namespace sundog
