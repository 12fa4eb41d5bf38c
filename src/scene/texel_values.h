// What images and textures hold, as linear colours on the host.
#pragma once

#include "scene/scene.h"

namespace sundog {

// Texel `index`, row by row, in linear light.
Vec3 linear_texel(const TexelImage& image, std::size_t index);

// Mean of a texture: of its texels, its squares, or, for an attribute, the values that the mesh has of it (none: 0).
// `mesh` may be null. Negative values count as 0.
Vec3 mean_color(const Scene& scene, uint texture, const TriangleMesh* mesh);

} // namespace sundog
