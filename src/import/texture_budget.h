// Bitmaps kept within a memory budget.
#pragma once

#include "base/warning.h"
#include "scene/scene.h"

#include <cstdint>

namespace sundog
{

struct BudgetedBitmap {
    std::shared_ptr<TexelImage> image; // textures share it
    int file_width = 0;
    int file_height = 0;
    SourceLocation where; // of the first that wants it
};

// Halves the width and height of the largest bitmap, again and again, until all together take at most `budget` bytes on
// the device or none is larger than a texel.
void fit_texture_budget(std::vector<BudgetedBitmap>& bitmaps, std::uint64_t budget);

// "the bitmap was scaled down from 64x32 to 32x16 texels ..."
Warning scaled_down_warning(const SourceLocation& where, const char* what, int file_width, int file_height, const TexelImage& image,
                            std::uint64_t budget);

// Half the width and height (rounded down, at least 1), each texel the mean of those that it covers, in linear light. Floats
// become half floats where these hold all of them, as in a file of that size.
TexelImage halved(const TexelImage& image);

} // namespace sundog
