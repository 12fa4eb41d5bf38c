// Unbiased photon gathering: the radius changes no mean.

#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

using namespace sundog;
using namespace sundog::test;

namespace
{

constexpr int replicates = 12;

// Glossy walls beside glass: trials in cones about diffuse and about rough lobes, and caustics in their reflections.
Scene glossy_box()
{
    Scene scene = cornell_box(32);
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    const uint rough = add_bsdf(scene, ConductorBsdf{{.2f, .9f, 1.1f}, {3.9f, 2.5f, 2.1f}, {}, Roughness{false, .3f, .3f}});
    scene.shapes.push_back(make_sphere({.4f, -.6f, .3f}, .4f, glass));
    scene.shapes.push_back(make_sphere({-.45f, -.55f, -.3f}, .45f, rough));
    return scene;
}

std::map<std::string, std::string> parameters(const std::string& radius = "")
{
    std::map<std::string, std::string> result{{"sampler", "independent"}, {"max_depth", "6"}, {"photons", "512"}};
    if (!radius.empty()) result["radius"] = radius;
    return result;
}

TEST(UnbiasedGathering, MeansStayOverAFourfoldSweepOfTheRadius)
{
    const Scene scene = glossy_box();
    std::vector<Estimate> estimates{estimate_image_mean(scene, {"bdpt", 48, parameters()}, replicates)};
    for (const char* radius : {"0.04", "0.08", "0.16"}) estimates.push_back(estimate_image_mean(scene, {"upg", 32, parameters(radius)}, replicates));
    // Bonferroni over six pairs at a family-wise 1%.
    const double quantile = student_quantile(replicates - 1, 0.005 / 6);
    for (std::size_t a = 0; a < estimates.size(); a++)
        for (std::size_t b = a + 1; b < estimates.size(); b++) {
            const double error = std::hypot(estimates[a].standard_error, estimates[b].standard_error);
            EXPECT_NEAR(estimates[a].mean, estimates[b].mean, quantile * error) << a << " and " << b;
            EXPECT_LT(error, 0.0125 * allowed_noise() * estimates[a].mean) << a << " and " << b;
        }
}

// Gathered photons have a share of the image: without it the sweep would show nothing.
TEST(UnbiasedGathering, OfVanishingRadiusIsBdpt)
{
    const Scene scene = glossy_box();
    const Image upg = render(scene, {"upg", 2, parameters("1e-6")}, 5), bdpt = render(scene, {"bdpt", 2, parameters()}, 5),
                wide = render(scene, {"upg", 2, parameters("0.1")}, 5);
    double difference = 0.0;
    for (int y = 0; y < 32; y++)
        for (int x = 0; x < 32; x++)
            for (int c = 0; c < 3; c++) {
                ASSERT_NEAR(upg.at(x, y, c), bdpt.at(x, y, c), 1e-4 * (1.0 + std::abs(bdpt.at(x, y, c))));
                difference += std::abs(wide.at(x, y, c) - bdpt.at(x, y, c));
            }
    EXPECT_GT(difference, 0.01 * 32 * 32 * 3 * image_mean(bdpt));
}

} // namespace
