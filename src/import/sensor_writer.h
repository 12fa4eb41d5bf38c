// The sensor of a scene file that is written, with its film and sampler.
#pragma once

#include "import/object_writer.h"

namespace sundog
{

// Throws SceneError for an orthographic sensor that leans so that its scale cannot be written to the last bit.
void write_sensor(ObjectWriter root, const Scene& scene);

} // namespace sundog
