// A clear sky and its sun, as images.
#pragma once

#include "scene/flatten_environment.h"

namespace sundog
{

Surroundings paint_sky(const SunSkyEmitter& emitter);

} // namespace sundog
