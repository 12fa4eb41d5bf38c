// The model of the clear sky against values of Mitsuba 3.7.1's sunsky emitter, whose coefficients are the same; and its images.
#include "scene/clear_sky.h"
#include "scene/paint_sky.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace sundog
{
namespace
{

constexpr double degree = std::numbers::pi / 180.0;

void expect_close(Vec3 value, Vec3 expected, float relative)
{
    EXPECT_NEAR(value.x, expected.x, relative * expected.x);
    EXPECT_NEAR(value.y, expected.y, relative * expected.y);
    EXPECT_NEAR(value.z, expected.z, relative * expected.z);
}

// Angles to the zenith and, of the direction, the azimuth from the sun's (degrees).
struct SkyValue {
    double turbidity;
    Vec3 albedo;
    double sun, polar, azimuth;
    Vec3 radiance;
};
constexpr SkyValue sky_values[] = {
    {1, {0.0f, 0.0f, 0.0f}, 10, 0, 0, {0.0228339f, 0.0448728f, 0.0872023f}},
    {1, {0.0f, 0.0f, 0.0f}, 10, 40, 30, {0.0221195f, 0.0465941f, 0.0992591f}},
    {1, {0.0f, 0.0f, 0.0f}, 10, 75, 180, {0.0481776f, 0.0844892f, 0.150022f}},
    {1, {0.0f, 0.0f, 0.0f}, 10, 89.5, 90, {0.101045f, 0.137099f, 0.156535f}},
    {3.5, {0.3f, 0.3f, 0.3f}, 55, 0, 0, {0.0213679f, 0.0369926f, 0.0712946f}},
    {3.5, {0.3f, 0.3f, 0.3f}, 55, 40, 30, {0.0679005f, 0.0896035f, 0.128792f}},
    {3.5, {0.3f, 0.3f, 0.3f}, 55, 75, 180, {0.0742741f, 0.118406f, 0.17982f}},
    {3.5, {0.3f, 0.3f, 0.3f}, 55, 89.5, 90, {0.122877f, 0.143819f, 0.144073f}},
    {6.2, {0.9f, 0.5f, 0.1f}, 86, 0, 0, {0.008059f, 0.0121322f, 0.0160855f}},
    {6.2, {0.9f, 0.5f, 0.1f}, 86, 40, 30, {0.0211955f, 0.0243653f, 0.0258932f}},
    {6.2, {0.9f, 0.5f, 0.1f}, 86, 75, 180, {0.0504633f, 0.053119f, 0.0432626f}},
    {6.2, {0.9f, 0.5f, 0.1f}, 86, 89.5, 90, {0.0326044f, 0.0186953f, 0.00677653f}},
    {10, {1.0f, 1.0f, 1.0f}, 0, 0, 0, {1.0205f, 0.95178f, 1.00424f}},
    {10, {1.0f, 1.0f, 1.0f}, 0, 40, 30, {0.176004f, 0.207184f, 0.243749f}},
    {10, {1.0f, 1.0f, 1.0f}, 0, 75, 180, {0.217916f, 0.217719f, 0.236158f}},
    {10, {1.0f, 1.0f, 1.0f}, 0, 89.5, 90, {0.329436f, 0.257958f, 0.241027f}},
};

TEST(ClearSky, SkyIsAsMitsubas)
{
    for (const SkyValue& v : sky_values) {
        const ClearSky sky(v.turbidity, v.albedo, (90.0 - v.sun) * degree);
        const double cosine = std::cos(v.polar * degree);
        const double cos_gamma = cosine * std::cos(v.sun * degree) + std::sin(v.polar * degree) * std::sin(v.sun * degree) * std::cos(v.azimuth * degree);
        expect_close(sky.sky(cosine, std::acos(std::min(cos_gamma, 1.0))), v.radiance, 2e-4f); // what single precision costs there
    }
}

// `above` (degrees) is where the direction meets the disk, from its middle towards the zenith or, where that is there, from it.
struct SunValue {
    double turbidity, sun, above;
    Vec3 radiance;
};
constexpr SunValue sun_values[] = {
    {1, 10, 0, {27376.5f, 24095.8f, 20082.3f}},
    {1, 10, -0.2, {23014.1f, 19521.4f, 15355.9f}},
    {1, 10, -0.26, {15832.1f, 12288.8f, 8364.35f}},
    {3.5, 55, 0, {24486.0f, 20317.8f, 14986.0f}},
    {3.5, 55, -0.2, {20592.6f, 16479.7f, 11483.8f}},
    {3.5, 55, -0.26, {14154.8f, 10372.9f, 6248.22f}},
    {6.2, 86, 0, {3138.89f, 1164.95f, 107.275f}},
    {6.2, 86, -0.2, {2876.5f, 1064.56f, 98.4139f}},
    {6.2, 86, -0.26, {2006.15f, 691.952f, 46.4102f}},
    {10, 0, 0, {18060.1f, 15214.1f, 13025.7f}},
    {10, 0, 0.2, {15174.3f, 12326.1f, 9957.19f}},
    {10, 0, 0.26, {10427.9f, 7761.06f, 5422.4f}},
};

TEST(ClearSky, SunIsAsMitsubas)
{
    for (const SunValue& v : sun_values) {
        const ClearSky sky(v.turbidity, {0.3f, 0.3f, 0.3f}, (90.0 - v.sun) * degree);
        const double radius = std::sin(v.above * degree) / std::sin(sun_half_angle);
        // The cosine of so small an angle has few digits in Mitsuba, the more so next to the limb.
        expect_close(sky.sun((90.0 - v.sun - v.above) * degree, std::sqrt(1.0 - radius * radius)), v.radiance, v.above == 0.0 ? 1e-3f : 2e-2f);
    }
}

double irradiance_of(const SunDisk& sun)
{
    return sun.mean_luminance * 2.0 * std::numbers::pi * static_cast<double>(sun.one_minus_cos);
}

TEST(PaintSky, AWiderSunHasTheSamePower)
{
    SunSkyEmitter emitter;
    emitter.sun_direction = {0.6f, 0, 0.8f};
    const double power = irradiance_of(*paint_sky(emitter).sun);
    for (const float aperture : {0.01f, 2.0f, 10.0f}) {
        emitter.sun_aperture = aperture;
        const auto sun = paint_sky(emitter).sun;
        EXPECT_NEAR(std::acos(1.0 - static_cast<double>(sun->one_minus_cos)) / degree, 0.5 * static_cast<double>(aperture), 0.02 * static_cast<double>(aperture));
        EXPECT_NEAR(irradiance_of(*sun), power, 0.01 * power); // the disk's elevations differ
    }
    emitter.sun_aperture = SunSkyEmitter().sun_aperture;
    emitter.limb_darkening = false;
    EXPECT_NEAR(irradiance_of(*paint_sky(emitter).sun), power, 1e-6 * power);
}

TEST(PaintSky, EndsAtTheHorizonUnlessItIsStretchedOrExtended)
{
    SunSkyEmitter emitter;
    emitter.sun_direction = {0.6f, 0, 0.8f};
    EXPECT_EQ(paint_sky(emitter).polar_range, 90.0 * degree);
    const double open = mean_luminance(paint_sky(emitter));
    emitter.stretch = 1.5f;
    EXPECT_EQ(paint_sky(emitter).polar_range, 135.0 * degree);
    // The sun stands lower by as much.
    const Vec3 sun = paint_sky(emitter).sun->direction;
    EXPECT_NEAR(std::acos(sun.z), 1.5 * std::acos(0.8), 1e-6);
    emitter.stretch = 1.0f;
    emitter.extend = true;
    EXPECT_EQ(paint_sky(emitter).polar_range, 180.0 * degree);
    EXPECT_GT(mean_luminance(paint_sky(emitter)), 1.05 * open);
}

TEST(PaintSky, SkyAndSunAlone)
{
    SunSkyEmitter emitter;
    emitter.sun_direction = {0, 0, 1}; // at the zenith
    const double both = mean_luminance(paint_sky(emitter));
    emitter.sun_scale = 0.0f;
    EXPECT_FALSE(paint_sky(emitter).sun);
    const double sky = mean_luminance(paint_sky(emitter));
    emitter.sun_scale = 1.0f;
    emitter.sky_scale = 0.0f;
    const double sun = mean_luminance(paint_sky(emitter));
    EXPECT_NEAR(sky + sun, both, 1e-9 * both);
    EXPECT_GT(sun, sky);
}

} // namespace
} // namespace sundog
