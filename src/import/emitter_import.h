// Emitters of a scene file.
#pragma once

#include "import/texture_import.h"
#include "scene/scene.h"

namespace sundog
{

// An emitter of the scene itself. Throws SceneError for unsupported ones, and for area emitters, which belong in a shape.
EmitterDescription import_emitter(const XmlElement& element, const SceneIndex& index, TextureImporter& textures);

// The emitter inside a shape. Throws SceneError for anything but an area emitter.
AreaEmitter import_area_emitter(const XmlElement& element, const SceneIndex& index, TextureImporter& textures);

} // namespace sundog
