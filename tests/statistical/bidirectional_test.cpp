// Bidirectional methods are one composition: without a part each is the method that never had it.

#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

using namespace sundog;
using namespace sundog::test;

namespace
{

Image render_glass_box(const std::string& method, const std::map<std::string, std::string>& parameters = {})
{
    return render(glass_box(32), {method, 3, parameters}, 5);
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
            estimate_image_mean(glass_box(32), {"vcm", 16, {{"photons", photons}, {"sampler", "independent"}, {"radius", "0.01"}}}, 12));
    for (const Estimate& e : estimates) {
        const double error = std::hypot(e.standard_error, estimates[1].standard_error);
        EXPECT_NEAR(e.mean, estimates[1].mean, student_quantile(11, 0.005 / 2) * error);
        EXPECT_LT(error, 0.02 * allowed_noise() * e.mean);
    }
}

} // namespace
