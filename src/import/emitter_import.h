// Emitters of a scene file.
#pragma once

#include "import/texture_import.h"
#include "scene/scene.h"

namespace sundog
{

// An emitter of the scene itself; nothing for one that is left out. Throws SceneError for unsupported ones unless they may be,
// and for area emitters, which belong in a shape.
std::optional<EmitterDescription> import_emitter(const XmlElement& element, const SceneIndex& index, TextureImporter& textures);

// The emitter inside a shape; nothing for one that is left out. Throws SceneError for others than area emitters.
std::optional<AreaEmitter> import_area_emitter(const XmlElement& element, const SceneIndex& index, TextureImporter& textures);

} // namespace sundog
