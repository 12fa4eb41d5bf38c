// The colours of error maps: what they promise of lightness, and which value has which.
#include "film/heat_map.h"
#include "math/srgb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sundog
{
namespace
{

// Of OKLab [Ottosson 2020], from linear sRGB.
double lightness(MapColor c)
{
    const double l = std::cbrt(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b);
    const double m = std::cbrt(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b);
    const double s = std::cbrt(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
    return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

TEST(HeatMap, EqualStepsAreEquallyLight)
{
    const double step = (lightness(map_color(1.0)) - lightness(map_color(0.0))) / 100;
    EXPECT_GT(step, 0.007);
    for (int i = 0; i < 100; i++) {
        const MapColor color = map_color(i / 100.0);
        EXPECT_NEAR(lightness(map_color((i + 1) / 100.0)) - lightness(color), step, 1e-4) << i;
        for (const float value : {color.r, color.g, color.b}) {
            EXPECT_GE(value, 0.0f);
            EXPECT_LE(value, 1.0f);
        }
    }
}

// An image of five grey pixels of radiance 1 with such bounds.
TEST(HeatMap, IsLogarithmicFromAThousandthToOne)
{
    const double root = std::sqrt(1.01);
    const double bounds[] = {0.0, 1e-3 * root, 0.1 * root, root, std::numeric_limits<double>::infinity()};
    Image image(5, 1, {"R", "G", "B", "depth.Z", "error.R", "error.G", "error.B"});
    for (int x = 0; x < 5; x++)
        for (int c = 0; c < 3; c++) {
            image.at(x, 0, c) = 1.0f;
            image.at(x, 0, 4 + c) = static_cast<float>(bounds[x]);
        }
    const Image map = heat_map(image);
    EXPECT_EQ(map.channels, (std::vector<std::string>{"R", "G", "B"}));
    const double expected[] = {0.0, 0.0, 2.0 / 3, 1.0, 1.0};
    for (int x = 0; x < 5; x++) {
        EXPECT_NEAR(map.at(x, 0, 0), map_color(expected[x]).r, 1e-3) << x;
        EXPECT_NEAR(map.at(x, 0, 2), map_color(expected[x]).b, 1e-3) << x;
    }
    EXPECT_THAT(heat_map_legend(), testing::HasSubstr("0.001"));
}

} // namespace
} // namespace sundog
