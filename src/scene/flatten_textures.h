// Textures and mesh attributes as the device's arrays.
#pragma once

#include "scene/flat_scene.h"

namespace sundog {

// Fills textures and texels; images that several textures share are stored once. Throws SceneError when texels are
// too many for 32-bit indices.
void flatten_textures(const Scene& scene, FlatScene& flat);

// Fills the attribute arrays and globals.attribute_count for the attributes that textures name; shapes and triangles
// must be there.
void list_attributes(const Scene& scene, FlatScene& flat);

} // namespace sundog
