// Emitters sky, sun and sunsky.
#pragma once

#include "import/object_reader.h"
#include "scene/scene.h"

namespace sundog
{

// Mitsuba 3 has `sunsky` alone; `sky` and `sun` are those of 0.6, and are read in both. Throws SceneError for values out of
// range and for a sun below the horizon.
SunSkyEmitter read_sun_sky(ObjectReader& reader);

} // namespace sundog
