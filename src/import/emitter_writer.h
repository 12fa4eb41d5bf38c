// Emitters of a scene file that is written, but for those of shapes.
#pragma once

#include "import/object_writer.h"

namespace sundog
{

void write_emitters(ObjectWriter root, const Scene& scene);

} // namespace sundog
