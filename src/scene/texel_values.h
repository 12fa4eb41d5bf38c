// What images and textures hold, as linear colours on the host.
#pragma once

#include "scene/scene.h"

namespace sundog {

// Texel `index`, row by row, in linear light.
Vec3 linear_texel(const TexelImage& image, std::size_t index);

// Gives a bitmap texels that are numbers rather than bytes, red, green and blue in turn: as half floats if those hold all of
// them, else as 32-bit ones. All bitmaps keep to this, so that a file of the numbers is read as the same texels.
void set_linear_texels(TexelImage& image, const std::vector<float>& values);

// Mean of a texture: of its texels, its squares, or, for an attribute, the values that the mesh has of it (none: 0).
// `mesh` may be null. Negative values count as 0.
Vec3 mean_color(const Scene& scene, uint texture, const TriangleMesh* mesh);

} // namespace sundog
