// Shapes of a scene file.
#pragma once

#include "import/bsdf_import.h"

namespace sundog
{

// Appends the shape, of the group if it is of one, with its BSDF and emitter; an OBJ file whose materials are used becomes one shape a
// material. Throws SceneError for unsupported shapes, unreadable or broken meshes, and values out of range.
void import_shape(const XmlElement& element, const SceneIndex& index, BsdfImporter& bsdfs, TextureImporter& textures, Scene& scene,
                  std::optional<uint> group = {});

} // namespace sundog
