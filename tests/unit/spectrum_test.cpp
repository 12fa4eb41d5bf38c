#include "math/srgb.h"
#include "scene/spectrum.h"

#include "scene/cie_tables.h"
#include "scene/materials.h"
#include "unit/scene_folder.h"

#include <vector>

namespace
{

using namespace sundog;
using sundog::testing::expect_near;

// Rec. 709 primaries to XYZ, the inverse of the reduction's last step.
std::array<double, 2> chromaticity(Vec3 rgb)
{
    const double x = 0.412453 * rgb.x + 0.357580 * rgb.y + 0.180423 * rgb.z;
    const double y = 0.212671 * rgb.x + 0.715160 * rgb.y + 0.072169 * rgb.z;
    const double z = 0.019334 * rgb.x + 0.119193 * rgb.y + 0.950227 * rgb.z;
    return {x / (x + y + z), y / (x + y + z)};
}

TEST(Spectrum, MatchingFunctionsFollowTheTables)
{
    // CIE 1931, 2 degrees: 450 nm (0.33620, 0.03800, 1.77211), 550 nm (0.43345, 0.99495, 0.00875), 600 nm
    // (1.0622, 0.6310, 0.0008); linear in between.
    expect_near(cie_1931(450), {0.33620f, 0.03800f, 1.77211f}, 1e-5f);
    expect_near(cie_1931(550), {0.43345f, 0.99495f, 0.00875f}, 1e-5f);
    expect_near(cie_1931(600), {1.0622f, 0.6310f, 0.0008f}, 1e-5f);
    expect_near(cie_1931(552.5), 0.5f * (cie_1931(550) + cie_1931(555)), 1e-6f);
    EXPECT_EQ(cie_1931(359), (Vec3{0, 0, 0}));
    EXPECT_EQ(cie_1931(831), (Vec3{0, 0, 0}));
}

TEST(Spectrum, WhiteStaysWhite)
{
    const std::vector<SpectrumSample> one = {{300, 1}, {900, 1}};
    const std::vector<SpectrumSample> half = {{300, 0.5}, {500, 0.5}, {900, 0.5}};
    expect_near(reflectance_to_rgb(one), {1, 1, 1}, 1e-6f);
    expect_near(reflectance_to_rgb(half), {0.5f, 0.5f, 0.5f}, 1e-6f);
    expect_near(index_to_rgb(std::vector<SpectrumSample>{{300, 1.5}, {900, 1.5}}), {1.5f, 1.5f, 1.5f}, 1e-5f);
    // As emission it is the equal-energy white, x = y = 1/3, of luminance 1.
    const Vec3 emitted = emission_to_rgb(one);
    EXPECT_NEAR(luminance(emitted), 1.0f, 2e-3f);
    const auto xy = chromaticity(emitted);
    EXPECT_NEAR(xy[0], 1.0 / 3.0, 2e-3);
    EXPECT_NEAR(xy[1], 1.0 / 3.0, 2e-3);
}

TEST(Spectrum, DaylightIsTheWhiteOfSrgb)
{
    // D65 as a reflectance-free light: chromaticity (0.31272, 0.32903) [CIE 15, table T.3].
    std::vector<SpectrumSample> samples;
    for (std::size_t i = 0; i < cie_rows().size(); i++)
        samples.push_back({cie_lambda_min + cie_lambda_step * static_cast<double>(i), static_cast<double>(cie_rows()[i].d65)});
    const auto xy = chromaticity(emission_to_rgb(samples));
    EXPECT_NEAR(xy[0], 0.31272, 2e-4);
    EXPECT_NEAR(xy[1], 0.32903, 2e-4);
}

// Made with mi.load_string in Mitsuba 3.7.1's scalar_rgb, whose white is 0.1 % off.
TEST(Spectrum, SamplesBecomeTheRgbOfMitsuba)
{
    const std::vector<SpectrumSample> warm = {{400, 0.1}, {500, 0.2}, {550, 0.35}, {600, 0.7}, {700, 0.8}};
    expect_near(reflectance_to_rgb(warm), {0.832488f, 0.345227f, 0.118959f}, 2e-3f);
    const std::vector<SpectrumSample> light = {{400, 1}, {500, 2}, {600, 6}, {700, 9}};
    expect_near(index_to_rgb(light), {7.53468f, 3.61815f, 1.19093f}, 0.015f);
    expect_near(emission_to_rgb(light), {8.72774f, 3.4597f, 1.02482f}, 0.015f);
}

TEST(Spectrum, BandsAreOrderedByWavelength)
{
    const Vec3 red = reflectance_to_rgb(std::vector<SpectrumSample>{{600, 0}, {610, 1}, {830, 1}});
    const Vec3 green = reflectance_to_rgb(std::vector<SpectrumSample>{{500, 0}, {510, 1}, {570, 1}, {580, 0}});
    const Vec3 blue = reflectance_to_rgb(std::vector<SpectrumSample>{{360, 1}, {480, 1}, {490, 0}});
    EXPECT_GT(red.x, 0.6f);
    EXPECT_LT(max_component({0, red.y, red.z}), 0.05f);
    EXPECT_GT(green.y, 0.6f);
    EXPECT_LT(max_component({green.x, 0, green.z}), 0.05f);
    EXPECT_GT(blue.z, 0.8f);
    EXPECT_LT(max_component({blue.x, blue.y, 0}), 0.1f);
    // Disjoint bands add up to no more than white.
    for (Vec3 c : {red, green, blue}) {
        EXPECT_GE(std::min({c.x, c.y, c.z}), 0.0f);
        EXPECT_LE(max_component(c), 1.0f);
    }
}

TEST(Spectrum, BlackBodiesLieOnThePlanckianLocus)
{
    // Chromaticities of the locus [Wyszecki and Stiles 1982, Color Science]: 2856 K is illuminant A.
    const struct {
        double kelvin, x, y;
    } known[] = {{2856, 0.4476, 0.4074}, {5000, 0.3451, 0.3516}, {6500, 0.3135, 0.3237}, {10000, 0.2807, 0.2884}};
    for (const auto& body : known) {
        const auto xy = chromaticity(blackbody_to_rgb(body.kelvin));
        EXPECT_NEAR(xy[0], body.x, 3e-3) << body.kelvin;
        EXPECT_NEAR(xy[1], body.y, 3e-3) << body.kelvin;
    }
}

TEST(Spectrum, BlackBodyRadianceIsPlancks)
{
    // Nearly flat in the visible: at 5800 K B(550 nm) = 2.62e4 W/m^2/sr/nm (Wien's peak is at 500 nm). The luminous
    // mean over the visible lies within a few percent of it.
    const float mean = luminance(blackbody_to_rgb(5800));
    EXPECT_NEAR(mean, 2.62e4f, 0.03f * 2.62e4f);
}

TEST(Spectrum, SrgbDecodingMeetsItsKnots)
{
    EXPECT_FLOAT_EQ(linear_from_srgb(0.0f), 0.0f);
    EXPECT_FLOAT_EQ(linear_from_srgb(1.0f), 1.0f);
    EXPECT_NEAR(linear_from_srgb(0.5f), 0.21404f, 1e-5f);
    EXPECT_NEAR(linear_from_srgb(0.04f), 0.04f / 12.92f, 1e-7f);
}

TEST(Materials, GoldMatchesItsMeasuredSpectrum)
{
    // Every fourth of the measured values; reduced as emission, which is how the table was made.
    const std::vector<SpectrumSample> eta = {{399.95, 1.658}, {427.53, 1.616}, {450.85, 1.502}, {459.20, 1.426}, {476.86, 1.242},
                                             {486.21, 1.087}, {495.94, 0.916}, {506.06, 0.755}, {516.60, 0.608}, {527.59, 0.492},
                                             {539.06, 0.402}, {551.04, 0.346}, {576.67, 0.268}, {604.80, 0.212}, {635.82, 0.178},
                                             {688.80, 0.160}, {751.42, 0.170}};
    const auto gold = find_conductor("Au");
    ASSERT_TRUE(gold);
    expect_near(emission_to_rgb(eta), gold->eta, 0.03f);
}

TEST(Materials, MetalsReflectInTheirColours)
{
    // Normal incidence: ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2).
    const auto reflectance = [](const ConductorConstants& c) {
        const auto r = [](float eta, float k) { return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k); };
        return Vec3{r(c.eta.x, c.k.x), r(c.eta.y, c.k.y), r(c.eta.z, c.k.z)};
    };
    const Vec3 gold = reflectance(*find_conductor("Au")), silver = reflectance(*find_conductor("Ag")),
               copper = reflectance(*find_conductor("Cu"));
    EXPECT_GT(gold.x, gold.y);
    EXPECT_GT(gold.y, gold.z);
    EXPECT_GT(copper.x, copper.y);
    EXPECT_GT(std::min({silver.x, silver.y, silver.z}), 0.88f);
    EXPECT_EQ(reflectance(*find_conductor("none")), (Vec3{1, 1, 1}));
    for (const char* name : {"Al", "Cr", "Ni_palik", "W", "TiN", "Cu_palik"}) EXPECT_TRUE(find_conductor(name)) << name;
    EXPECT_FALSE(find_conductor("Unobtainium"));
}

TEST(Materials, IndicesOfRefractionByName)
{
    EXPECT_EQ(find_ior("Diamond"), 2.419f);
    EXPECT_EQ(find_ior("water"), 1.333f);
    EXPECT_FALSE(find_ior("butter"));
    EXPECT_NE(ior_names().find("bk7"), std::string::npos);
}

} // namespace
