// Shapes of a scene file that is written.
#pragma once

#include "import/bsdf_writer.h"

namespace sundog
{

// With the groups and their instances, in the order in which all are numbered when they are read again, as are textures
// and BSDFs by their first use.
void write_shapes(ObjectWriter root, const Scene& scene, WrittenIds& ids, const TextureWriter& textures, const BsdfWriter& bsdfs,
                  WrittenFiles& files);

} // namespace sundog
