#include "import/texture_budget.h"

#include "import/texel_rows.h"
#include "scene/texel_values.h"

#include <algorithm>

namespace sundog
{

namespace
{

std::uint64_t bytes_of(const BudgetedBitmap& bitmap)
{
    return bitmap.image->texels.size() * sizeof(uint);
}

std::string size_text(int width, int height)
{
    return std::to_string(width) + "x" + std::to_string(height);
}

} // namespace

TexelImage halved(const TexelImage& image)
{
    TexelRows rows(image.width, image.height, image.format, 1);
    const std::size_t row = static_cast<std::size_t>(image.width) * image.words_per_texel();
    for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); y++) rows.add(std::span(image.texels).subspan(y * row, row));
    TexelImage half = rows.image();
    narrow(half);
    return half;
}

void fit_texture_budget(std::vector<BudgetedBitmap>& bitmaps, std::uint64_t budget)
{
    std::uint64_t total = 0;
    for (const auto& bitmap : bitmaps) total += bytes_of(bitmap);
    const auto smaller = [](const BudgetedBitmap& a, const BudgetedBitmap& b) { return bytes_of(a) < bytes_of(b); };
    while (total > budget) {
        const auto largest = std::max_element(bitmaps.begin(), bitmaps.end(), smaller);
        if (largest->image->width == 1 && largest->image->height == 1) break;
        total -= bytes_of(*largest);
        *largest->image = halved(*largest->image);
        total += bytes_of(*largest);
    }
}

Warning scaled_down_warning(const SourceLocation& where, const char* what, int file_width, int file_height, const TexelImage& image,
                            std::uint64_t budget)
{
    return {where.prefix() + "the " + what + " was scaled down from " + size_text(file_width, file_height) + " to " + size_text(image.width, image.height) +
                " texels to keep all within " + std::to_string(budget / 1'000'000) + " MB: --texture-memory allows more",
            WarningKind::approximated};
}

} // namespace sundog
