// Radii of progressive methods: the closed schedule against its recurrence, and the automatic first radius.
#include "methods/bias_estimate.h"
#include "methods/standard_parameters.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sundog
{
namespace
{

Parameters radius_parameters(const std::string& radius)
{
    return Parameters("pppm", {radius_spec()}, {{"radius", {radius, {}}}});
}

// r_{i+1} = r_i ((i + alpha) / (i + 1))^{1/d}, from i = 1.
TEST(RadiusSchedule, FollowsItsRecurrence)
{
    for (const double alpha : {0.1, 0.5, 2.0 / 3.0, 0.9})
        for (const int dimensions : {1, 2, 3}) {
            double radius = 0.25;
            for (std::uint64_t iteration = 0; iteration <= 100'000; ++iteration) {
                if (iteration > 0) {
                    const double i = static_cast<double>(iteration);
                    radius *= std::pow((i + alpha) / (i + 1.0), 1.0 / dimensions);
                }
                if (iteration > 1000 && iteration % 997 != 0) continue;
                ASSERT_NEAR(scheduled_radius(0.25, alpha, dimensions, iteration) / radius, 1.0, 1e-9)
                    << "alpha " << alpha << ", " << dimensions << " dimensions, iteration " << iteration;
            }
        }
}

TEST(RadiusSchedule, StartsAtTheFirstRadiusAndStaysThereAtAlphaOne)
{
    EXPECT_DOUBLE_EQ(scheduled_radius(3.0, 0.5, 2, 0), 3.0);
    for (const std::uint64_t iteration : {1ull, 10ull, 1'000'000ull}) EXPECT_NEAR(scheduled_radius(3.0, 1.0, 2, iteration), 3.0, 3e-9);
}

// r^d ~ i^(alpha - 1) / Gamma(1 + alpha).
TEST(RadiusSchedule, ShrinksByItsPowerLaw)
{
    const double alpha = 2.0 / 3.0;
    for (const int dimensions : {1, 2, 3}) {
        const double i = 1e9;
        const double limit = std::pow(std::pow(i, alpha - 1.0) / std::tgamma(1.0 + alpha), 1.0 / dimensions);
        EXPECT_NEAR(scheduled_radius(1.0, alpha, dimensions, 1'000'000'000) / limit, 1.0, 1e-5) << dimensions;
    }
}

constexpr float large_pixel = 1.0f; // of the scene's size: leaves the choice to the photons' density

TEST(InitialRadius, IsWhatTheUserAsksFor)
{
    EXPECT_EQ(initial_radius(radius_parameters("0.125"), 50.0f, 1000, 0.01f), 0.125f);
}

// Millimetres or kilometres: the same picture.
TEST(InitialRadius, ScalesWithTheScene)
{
    const Parameters automatic = radius_parameters("0");
    const float unit = initial_radius(automatic, 1.0f, 100'000, large_pixel);
    EXPECT_GT(unit, 0.0f);
    EXPECT_LT(unit, 1.0f);
    for (const float scale : {1e-3f, 1e3f}) EXPECT_NEAR(initial_radius(automatic, scale, 100'000, scale * large_pixel) / (scale * unit), 1.0, 1e-6);
}

// N r^2 stays: a query finds as many photons however many are emitted.
TEST(InitialRadius, KeepsTheNumberOfPhotonsFound)
{
    const Parameters automatic = radius_parameters("0");
    const double few = initial_radius(automatic, 1.0f, 1000, large_pixel), many = initial_radius(automatic, 1.0f, 4'000'000, large_pixel);
    EXPECT_NEAR(few * few * 1000, many * many * 4'000'000, 1e-4 * few * few * 1000);
}

// With few photons a fine image is not blurred by more than a few pixels; with many it does not matter.
TEST(InitialRadius, IsAtMostAFewPixels)
{
    const Parameters automatic = radius_parameters("0");
    EXPECT_NEAR(initial_radius(automatic, 1.0f, 1000, 0.001f), 0.004f, 1e-6f);
    EXPECT_EQ(initial_radius(automatic, 1.0f, 4'000'000, 0.01f), initial_radius(automatic, 1.0f, 4'000'000, large_pixel));
}

TEST(PixelFootprint, IsAPixelsWidthAtTheMiddleOfTheScene)
{
    Camera camera{};
    camera.position = {0, 0, 5};
    camera.half_width = 0.5f;
    camera.film_width = 100;
    EXPECT_NEAR(pixel_footprint(camera, {{-1, -1, -1}, {1, 1, 1}}), 0.05f, 1e-6f);
    camera.kind = CAMERA_ORTHOGRAPHIC; // whatever the distance: the side of a square as large as a pixel
    camera.half_height = 0.5f;
    camera.film_height = 25;
    EXPECT_NEAR(pixel_footprint(camera, {{-1, -1, -1}, {1, 1, 1}}), 0.02f, 1e-6f);
    camera.kind = CAMERA_PERSPECTIVE;
    camera.position = {0, 0, 0}; // inside: half the bounding sphere's radius away
    EXPECT_NEAR(pixel_footprint(camera, {{-1, -1, -1}, {1, 1, 1}}), 0.005f * std::sqrt(3.0f), 1e-6f);
}

// The variance of one Laplacian goes as h^-6. Radii as of an optimal schedule, i^(-1/6), would leave that of their mean as
// it is; those of their own make it fall as n^-0.4.
TEST(LaplacianRadius, LetsMeansOfLaplaciansConverge)
{
    const auto variance_of_mean = [](std::uint64_t n) {
        double sum = 0.0;
        for (std::uint64_t i = 0; i < n; i++) sum += std::pow(laplacian_radius(1.0f, i), -6.0);
        return sum / (static_cast<double>(n) * static_cast<double>(n));
    };
    EXPECT_EQ(laplacian_radius(0.25f, 0), 0.5f);
    EXPECT_NEAR(laplacian_radius(0.25f, 1023), 0.25, 1e-6);
    EXPECT_NEAR(variance_of_mean(100'000) / variance_of_mean(1'000), std::pow(100.0, -0.4), 0.01);
}

} // namespace
} // namespace sundog
