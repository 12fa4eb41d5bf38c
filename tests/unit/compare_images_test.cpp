// Image differences against values worked out by hand.
#include "base/errors.h"
#include "film/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace sundog {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Image rgb(int width, int height, std::vector<float> pixels)
{
    Image image(width, height, {"R", "G", "B"});
    image.pixels = std::move(pixels);
    return image;
}

TEST(CompareImages, metrics_by_hand)
{
    const Image a = rgb(2, 1, {1, 2, 3, 0, 0, 0});
    const Image b = rgb(2, 1, {2, 2, 1, 0.5f, 0, 0});
    const ImageDifference d = compare_images(a, b);
    EXPECT_DOUBLE_EQ(d.mse, (1 + 0 + 4 + 0.25) / 6);
    EXPECT_DOUBLE_EQ(d.rmse, std::sqrt((1 + 0 + 4 + 0.25) / 6));
    EXPECT_DOUBLE_EQ(d.relmse, (1 / 4.01 + 4 / 1.01 + 0.25 / 0.26) / 6);
    EXPECT_DOUBLE_EQ(d.mae, (1 + 2 + 0.5) / 6);
    EXPECT_DOUBLE_EQ(d.mean_ratio, 6 / 5.5);
    EXPECT_EQ(d.find("mae"), d.mae);
    EXPECT_EQ(d.find("psnr"), std::nullopt);
}

TEST(CompareImages, equal_images_differ_by_nothing)
{
    const Image a = rgb(1, 2, {1, 2, 3, 4, 5, 6});
    const ImageDifference d = compare_images(a, a);
    EXPECT_EQ(d.mse, 0);
    EXPECT_EQ(d.relmse, 0);
    EXPECT_EQ(d.mean_ratio, 1);
    const Image black = rgb(1, 1, {0, 0, 0});
    EXPECT_EQ(compare_images(black, black).mean_ratio, 1);
    EXPECT_TRUE(std::isinf(compare_images(rgb(1, 1, {1, 1, 1}), black).mean_ratio));
}

TEST(CompareImages, only_colour_channels_count_and_in_any_order)
{
    Image a(1, 1, {"variance.R", "B", "G", "R"});
    a.pixels = {std::numeric_limits<float>::quiet_NaN(), 3, 2, 1};
    EXPECT_EQ(compare_images(a, rgb(1, 1, {1, 2, 3})).mse, 0);
}

TEST(CompareImages, sizes_and_invalid_pixels_are_refused)
{
    const Image small = rgb(1, 1, {1, 2, 3}), large = rgb(1, 2, {1, 2, 3, 4, 5, 6});
    EXPECT_THAT([&] { compare_images(small, large, "a.exr", "b.exr"); },
                ThrowsMessage<FileError>(HasSubstr("a.exr is 1x1 but b.exr is 1x2")));
    for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        const Image broken = rgb(1, 2, {1, 2, 3, 4, bad, 6});
        EXPECT_THAT([&] { compare_images(broken, large, "a.exr", "b.exr"); }, ThrowsMessage<FileError>(HasSubstr("a.exr: pixel (0, 1) is ")));
        EXPECT_THAT([&] { compare_images(large, broken, "a.exr", "b.exr"); }, ThrowsMessage<FileError>(HasSubstr("b.exr: pixel (0, 1) is ")));
    }
}

// A million pixels of 0.1 against 0.1 + 2^-20: float sums would lose the difference.
TEST(CompareImages, large_images_keep_small_differences)
{
    Image a(1000, 1000, {"R", "G", "B"}), b(1000, 1000, {"R", "G", "B"});
    for (float& value : a.pixels) value = 1.0f;
    for (float& value : b.pixels) value = 1.0f + 0x1p-20f;
    const ImageDifference d = compare_images(a, b);
    EXPECT_NEAR(d.mae / 0x1p-20, 1.0, 1e-12);
    EXPECT_NEAR(d.mse / 0x1p-40, 1.0, 1e-12);
}

} // namespace
} // namespace sundog
