// Emitters of a scene file that is written, but for those of shapes.
#pragma once

#include "import/texture_writer.h"

namespace sundog
{

// In their order. Throws SceneError for what cannot be written to the last bit, and FileError.
void write_emitters(ObjectWriter root, const Scene& scene, const TextureWriter& textures, WrittenFiles& files);

} // namespace sundog
