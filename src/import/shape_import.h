// Shapes of a scene file.
#pragma once

#include "import/bsdf_import.h"

namespace sundog
{

// Appends the shape with its BSDF and emitter; an OBJ file whose materials are used becomes one shape a material.
// Throws SceneError for unsupported shapes, unreadable or broken meshes, and values out of range.
void import_shape(const XmlElement& element, const SceneIndex& index, BsdfImporter& bsdfs, TextureImporter& textures, Scene& scene);

} // namespace sundog
