// Bitmaps kept within a memory budget.
#pragma once

#include "base/warning.h"
#include "scene/scene.h"

#include <cstdint>

namespace sundog
{

// Halves the width and height of the largest bitmap, again and again, until all together take at most `budget` bytes on
// the device or none is larger than a texel. A warning for each bitmap that changed, with its old and new size. Bitmaps
// that several textures share count once.
void fit_texture_budget(Scene& scene, std::uint64_t budget, std::vector<Warning>& warnings);

// Half the width and height (rounded down, at least 1), each texel the mean of those that it covers, in linear light. Floats
// become half floats where these hold all of them (set_linear_texels), as in a file of that size.
TexelImage halved(const TexelImage& image);

} // namespace sundog
