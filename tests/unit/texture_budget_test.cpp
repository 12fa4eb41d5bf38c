// Bitmaps within their budget, and the half-precision numbers that they may hold.
#include "import/texture_budget.h"
#include "math/half.h"

#include <gmock/gmock.h>

namespace sundog
{
namespace
{

using ::testing::HasSubstr;

TEST(Half, RoundTripsEveryNumber)
{
    for (uint bits = 0; bits < 0x10000; ++bits) {
        const auto half = static_cast<std::uint16_t>(bits);
        const float value = float_from_half(half);
        if (std::isnan(value)) continue;
        ASSERT_EQ(half_from_float(value), half) << value;
    }
}

TEST(Half, RoundsToTheNearestAndTiesToEven)
{
    for (uint bits = 0; bits < 0x7bff; ++bits) {
        const double a = float_from_half(static_cast<std::uint16_t>(bits)), b = float_from_half(static_cast<std::uint16_t>(bits + 1));
        ASSERT_EQ(half_from_float(static_cast<float>(a + 0.49 * (b - a))), bits);
        ASSERT_EQ(half_from_float(static_cast<float>(a + 0.51 * (b - a))), bits + 1);
        ASSERT_EQ(half_from_float(static_cast<float>(a + 0.5 * (b - a))), bits % 2 == 0 ? bits : bits + 1);
    }
    EXPECT_TRUE(std::isinf(float_from_half(half_from_float(1e6f))));
    EXPECT_EQ(half_from_float(65519.0f), half_from_float(largest_half));
    EXPECT_TRUE(std::isnan(float_from_half(half_from_float(NAN))));
    EXPECT_EQ(half_from_float(-2.0f), 0xc000);
}

TexelImage image_of(int width, int height, TexelFormat format = TexelFormat::linear8, uint texel = 0x0a141e)
{
    TexelImage image;
    image.width = width;
    image.height = height;
    image.format = format;
    image.texels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * image.words_per_texel(), texel);
    return image;
}

BudgetedBitmap bitmap_of(int width, int height)
{
    return {std::make_shared<TexelImage>(image_of(width, height)), width, height, {"a.xml", 1}};
}

TEST(TextureBudget, LargestBitmapsShrinkFirst)
{
    std::vector<BudgetedBitmap> bitmaps{bitmap_of(64, 32), bitmap_of(16, 16)}; // 8192 and 1024 bytes
    fit_texture_budget(bitmaps, 9216);
    EXPECT_EQ(bitmaps[0].image->width, 64);
    const std::shared_ptr<const TexelImage> shared = bitmaps[0].image;
    fit_texture_budget(bitmaps, 9215);
    EXPECT_EQ(shared->width, 32) << "for all who use it";
    EXPECT_EQ(shared->height, 16);
    EXPECT_EQ(bitmaps[1].image->width, 16);
    EXPECT_THAT(scaled_down_warning(bitmaps[0].where, "bitmap", 64, 32, *shared, 9215).text, HasSubstr("a.xml:1: the bitmap was scaled down from 64x32 to 32x16"));
    fit_texture_budget(bitmaps, 0);
    EXPECT_EQ(shared->texels.size(), 1u) << "never less than a texel";
}

TEST(TextureBudget, TexelsAreAveragedInLinearLight)
{
    TexelImage image;
    image.width = 2;
    image.height = 1;
    image.format = TexelFormat::srgb8;
    image.texels = {0x000000, 0xffffff};
    EXPECT_EQ(halved(image).texels, (std::vector<uint>{0xbcbcbc})) << "188 is the display value of half the light";
    image.format = TexelFormat::linear8;
    EXPECT_EQ(halved(image).texels, (std::vector<uint>{0x808080}));
    image.format = TexelFormat::half;
    image.texels = {half_from_float(1.0f) | static_cast<uint>(half_from_float(8.0f)) << 16, half_from_float(0.5f),
                    half_from_float(3.0f) | static_cast<uint>(half_from_float(0.0f)) << 16, half_from_float(0.25f)};
    EXPECT_EQ(halved(image).texels, (std::vector<uint>{half_from_float(2.0f) | static_cast<uint>(half_from_float(4.0f)) << 16, half_from_float(0.375f)}));
    const TexelImage odd = image_of(5, 3);
    EXPECT_EQ(halved(odd).width, 2);
    EXPECT_EQ(halved(odd).height, 1);
    EXPECT_EQ(halved(odd).texels, (std::vector<uint>(2, 0x0a141e)));
}

} // namespace
} // namespace sundog
