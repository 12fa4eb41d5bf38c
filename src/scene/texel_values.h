// What images and textures hold, as linear colours on the host.
#pragma once

#include "scene/scene.h"

namespace sundog {

// Texel `index`, row by row, in linear light.
Vec3 linear_texel(const TexelImage& image, std::size_t index);

// The texel whose first word this is.
Vec3 linear_texel(TexelFormat format, const uint* words);

// Whether texels are bytes; else they are numbers.
bool is_of_bytes(TexelFormat format);
// Adds a texel of numbers.
void append_numbers(TexelFormat format, Vec3 texel, std::vector<uint>& texels);
// Makes half floats of 32-bit ones where those hold all of them. All bitmaps keep to this, so that a file of the numbers is read as
// the same texels.
void narrow(TexelImage& image);

// Mean of a texture: of its texels, its squares, or, for an attribute, the values that the mesh has of it (none: 0).
// `mesh` may be null. Negative values count as 0.
Vec3 mean_color(const Scene& scene, uint texture, const TriangleMesh* mesh);

} // namespace sundog
