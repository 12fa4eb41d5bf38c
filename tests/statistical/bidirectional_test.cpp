// Bidirectional methods are one composition: without a part each is the method that never had it.

#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

using namespace sundog;
using namespace sundog::test;

namespace
{

Scene glass_box()
{
    Scene scene = cornell_box(32);
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    scene.shapes.push_back(make_sphere({.4f, -.6f, .3f}, .4f, glass));
    return scene;
}

Image render_glass_box(const std::string& method, const std::map<std::string, std::string>& parameters = {})
{
    return render(glass_box(), {method, 3, parameters}, 5);
}

TEST(Bidirectional, VcmWithoutMergingIsBdptBitForBit)
{
    EXPECT_EQ(render_glass_box("vcm", {{"merging", "false"}}).pixels, render_glass_box("bdpt").pixels);
}

TEST(Bidirectional, VcmWithoutConnectionsIsBpmBitForBit)
{
    EXPECT_EQ(render_glass_box("vcm", {{"connections", "none"}}).pixels, render_glass_box("bpm").pixels);
}

// With a radius that no photon lies within merging adds nothing, and its share of the weights is gone.
TEST(Bidirectional, VcmOfVanishingRadiusIsBdpt)
{
    const Image vcm = render_glass_box("vcm", {{"radius", "1e-6"}}), bdpt = render_glass_box("bdpt");
    // The share is pi r^2 N p for densities up to 1e2 / m^2 or so: 1e-7, and rounding beside it.
    for (std::size_t i = 0; i < vcm.pixels.size(); i++) ASSERT_NEAR(vcm.pixels[i], bdpt.pixels[i], 1e-4 * (1.0 + std::abs(bdpt.pixels[i])));
}

// More light subpaths than camera subpaths, and fewer: the mean stays.
TEST(Bidirectional, LightSubpathsNeedNotBeOneAPixel)
{
    std::vector<Estimate> estimates;
    for (const char* photons : {"100", "1024", "5000"})
        estimates.push_back(
            estimate_image_mean(glass_box(), {"vcm", 16, {{"photons", photons}, {"sampler", "independent"}, {"radius", "0.01"}}}, 12));
    for (const Estimate& e : estimates) {
        const double error = std::hypot(e.standard_error, estimates[1].standard_error);
        EXPECT_NEAR(e.mean, estimates[1].mean, student_quantile(11, 0.005 / 2) * error);
        EXPECT_LT(error, 0.02 * e.mean);
    }
}

// Each pixel connects to a light subpath of its own. Were that the same place of the low-discrepancy sequence in every
// iteration, the pixel would see one light subpath for ever, and its error would not fall.
TEST(Bidirectional, ErrorOfSobolPointsFalls)
{
    const Scene scene = glass_box();
    const Image few = render(scene, {"bdpt", 8, {}}, 1), many = render(scene, {"bdpt", 128, {}}, 2),
                reference = render(scene, {"bdpt", 1024, {}}, 3);
    const auto error = [&](const Image& image) {
        double sum = 0.0;
        for (std::size_t i = 0; i < image.pixels.size(); i++) {
            const double b = reference.pixels[i], d = image.pixels[i] - b;
            sum += d * d / (b * b + 0.01);
        }
        return sum;
    };
    // 16 times the points: independent ones would leave 1/16 of the variance, and with the reference's own 1/8 of what 128 leave.
    EXPECT_LT(error(many), 0.15 * error(few));
}

} // namespace
