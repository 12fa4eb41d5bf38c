// Shapes of a scene file that is written.
#pragma once

#include "import/bsdf_writer.h"

namespace sundog
{

// In their order, by which their BSDFs are numbered when they are read again.
void write_shapes(ObjectWriter root, const Scene& scene, WrittenIds& ids, const BsdfWriter& bsdfs, WrittenFiles& files);

} // namespace sundog
