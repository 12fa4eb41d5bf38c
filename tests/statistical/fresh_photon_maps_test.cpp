// photonmapper with maps of each iteration's own: one map's image by other seeds, in the mean; noise that falls; and the bias that it
// tells of its lookups, where that is known.
#include "support/cornell_scene.h"
#include "support/point_over_plane.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <numbers>
#include <unistd.h>

using namespace sundog;
using namespace sundog::test;
using std::numbers::pi;

namespace
{

RenderRequest request(const std::string& maps, std::uint64_t iterations, const std::map<std::string, std::string>& more = {})
{
    RenderRequest r{"photonmapper",
                    iterations,
                    {{"maps", maps}, {"photons", "4096"}, {"caustic_photons", "4096"}, {"radius", "0.1"}, {"caustic_radius", "0.05"}}};
    for (const auto& [name, value] : more) r.parameters[name] = value;
    return r;
}

RenderSettings settings_of(const RenderRequest& r, std::uint64_t seed)
{
    RenderSettings settings;
    settings.method = r.method;
    settings.parameters = r.parameters;
    settings.seed = seed;
    return settings;
}

// The first iteration has the map that one map would be, and those of all are as good as maps of other seeds.
TEST(FreshPhotonMaps, MeanIsThatOfOneMapOverSeeds)
{
    const Scene scene = glass_box(16);
    EXPECT_TRUE(render(scene, request("fresh", 1), 3).pixels == render(scene, request("one", 1), 3).pixels);
    for (const char* lookup : {"radius", "nearest"}) {
        SCOPED_TRACE(lookup);
        const std::map<std::string, std::string> parameters{{"lookup", lookup}, {"sampler", "independent"}};
        const Estimate fresh = estimate_lower_half(scene, request("fresh", 8, parameters), 6),
                       one = estimate_lower_half(scene, request("one", 4, parameters), 16);
        const double error = std::hypot(fresh.standard_error, one.standard_error);
        EXPECT_NEAR(fresh.mean, one.mean, student_quantile(5, 0.005 / 2) * error);
        EXPECT_LT(error, 0.02 * allowed_noise() * one.mean);
    }
}

// All light by photons that are looked up at once. From 2 to 18 iterations the noise of independent maps falls to a third; over 256
// pixels and 6 seeds the ratio is known within a tenth, for few dozen disks are independent.
TEST(FreshPhotonMaps, NoiseFallsWithIterations)
{
    const Scene scene = PointOverPlane{16, 1.5}.scene();
    const std::map<std::string, std::string> parameters{
        {"direct", "photons"}, {"photons", "1000"}, {"caustic_photons", "2048"}, {"caustic_radius", "0.25"}, {"sampler", "independent"}};
    const double few = relative_noise(scene, request("fresh", 2, parameters)), many = relative_noise(scene, request("fresh", 18, parameters));
    EXPECT_NEAR(many / few, 1.0 / 3.0, 0.1);
    EXPECT_GT(relative_noise(scene, request("one", 18, parameters)), 1.2 * few);
}

TEST(FreshPhotonMaps, ResumedIsUninterrupted)
{
    const auto file = std::filesystem::temp_directory_path() / ("sundog-fresh-maps-" + std::to_string(::getpid()));
    for (const std::map<std::string, std::string>& parameters :
         {std::map<std::string, std::string>{{"lookup", "nearest"}, {"importons", "800"}},
          {{"final_gather", "false"}, {"spectral", "true"}}}) {
        SCOPED_TRACE(testing::PrintToString(parameters));
        const RenderSettings settings = settings_of(request("fresh", 0, parameters), 7);
        RenderSession whole(glass_box(11), shared_device(), settings);
        for (int i = 0; i < 2; i++) whole.iterate();
        whole.save_checkpoint(file);
        for (int i = 0; i < 2; i++) whole.iterate();
        RenderSession resumed(glass_box(11), shared_device(), settings);
        resumed.resume(file);
        for (int i = 0; i < 2; i++) resumed.iterate();
        std::filesystem::remove(file);
        EXPECT_TRUE(resumed.image().pixels == whole.image().pixels);
        const MethodCounters a = resumed.statistics().counters, b = whole.statistics().counters;
        EXPECT_EQ(a.light_subpaths, b.light_subpaths);
        EXPECT_EQ(a.light_subpaths, 4u * 2 * 4096);
        EXPECT_EQ(a.photons_stored, b.photons_stored);
        EXPECT_EQ(a.rays, b.rays);
    }
}

// Means over the image of what is seen and of its estimated bias, in red, by seed.
struct Means {
    std::vector<double> seen, bias;
    std::vector<double> corrected() const
    {
        std::vector<double> values;
        for (std::size_t i = 0; i < seen.size(); i++) values.push_back(seen[i] - bias[i]);
        return values;
    }
};

Means means_with_errors(const Scene& scene, const RenderRequest& r, int seeds)
{
    Means means;
    for (int seed = 1; seed <= seeds; seed++) {
        RenderSettings settings = settings_of(r, static_cast<std::uint64_t>(seed));
        settings.errors = ErrorSettings{};
        RenderSession session(scene, shared_device(), settings);
        for (std::uint64_t i = 0; i < r.iterations; i++) session.iterate();
        const Image image = session.image();
        const auto channel = std::find(image.channels.begin(), image.channels.end(), "bias.R") - image.channels.begin();
        double seen = 0.0, bias = 0.0;
        for (int y = 0; y < image.height; y++)
            for (int x = 0; x < image.width; x++) {
                seen += static_cast<double>(image.at(x, y, 0));
                bias += static_cast<double>(image.at(x, y, static_cast<int>(channel)));
            }
        const double pixels = static_cast<double>(image.width) * image.height;
        means.seen.push_back(seen / pixels);
        means.bias.push_back(bias / pixels);
    }
    return means;
}

// Looked up at once, under a lamp. What the Laplacian leaves is of fourth order, at h = 0.3 or 0.4 up to 1/6 of the bias.
TEST(FreshPhotonMaps, BiasOfALookupIsThatOfThePlane)
{
    const PointOverPlane plane{8, 0.3};
    double truth = 0.0;
    for (int y = 0; y < plane.size; y++)
        for (int x = 0; x < plane.size; x++) truth += plane.answer(x, y) / (plane.size * plane.size);
    const auto expect_bias = [&](const std::map<std::string, std::string>& parameters, std::uint64_t iterations, int seeds) {
        SCOPED_TRACE(testing::PrintToString(parameters));
        RenderRequest r = request("fresh", iterations, {{"direct", "photons"}, {"photons", "1000"}, {"caustic_photons", "16384"}});
        for (const auto& [name, value] : parameters) r.parameters[name] = value;
        const Means means = means_with_errors(plane.scene(), r, seeds);
        const Estimate bias = estimate_from(means.bias), corrected = estimate_from(means.corrected());
        EXPECT_LT(bias.mean, 0.0); // under a lamp light is convex downwards
        const double tolerance = student_quantile(seeds - 1, 0.005 / 2) * corrected.standard_error;
        EXPECT_NEAR(corrected.mean, truth, tolerance + 0.2 * std::abs(bias.mean));
        EXPECT_LT(tolerance, 0.3 * std::abs(bias.mean));
    };
    expect_bias({{"caustic_radius", "0.2"}}, 8, 4);
    expect_bias({{"caustic_radius", "0.2"}, {"kernel", "cone"}}, 8, 4);
}

// k - 1 photons over the area within the k-th, which is where chance has put it: pi r_k^2 N (1 + rho^2)^(-3/2) / 4 pi has the mean k, and
// the Laplacian of (1 + rho^2)^(-3/2) is (9 rho^2 - 6) (1 + rho^2)^(-7/2). What is left is of fourth order, a tenth or so; the k-th photon
// itself would take half of the bias away.
TEST(FreshPhotonMaps, BiasOfNearestPhotonsIsThatOfThePlane)
{
    constexpr int k = 20, paths = 2000, seeds = 6;
    const PointOverPlane plane{8, 0.3};
    double expected = 0.0;
    for (int y = 0; y < plane.size; y++)
        for (int x = 0; x < plane.size; x++) {
            const auto on_plane = [&](int pixel) { return plane.half_patch * (2.0 * (pixel + 0.5) / plane.size - 1.0); };
            const double squares = 1.0 + std::pow(on_plane(x), 2) + std::pow(on_plane(y), 2);
            const double radius_squared = 4.0 * k / paths * std::pow(squares, 1.5);
            const double laplacian = (9.0 * squares - 15.0) * std::pow(squares, -3.5) * PointOverPlane::reflectance / pi;
            expected += (1.0 - 1.0 / k) / 12.0 * radius_squared * laplacian / (plane.size * plane.size); // Epanechnikov's mu_2 / 2
        }
    const RenderRequest r = request("fresh", 64,
                                    {{"direct", "photons"},
                                     {"photons", "100"},
                                     {"caustic_photons", std::to_string(paths)},
                                     {"caustic_radius", "1"},
                                     {"lookup", "nearest"},
                                     {"nearest", std::to_string(k)},
                                     {"sampler", "independent"}});
    const Estimate bias = estimate_from(means_with_errors(plane.scene(), r, seeds).bias);
    const double tolerance = student_quantile(seeds - 1, 0.005) * bias.standard_error;
    EXPECT_NEAR(bias.mean, expected, tolerance + 0.12 * std::abs(expected));
    EXPECT_LT(tolerance, 0.2 * std::abs(expected));
}

// Integral of E over the plane about the lamp's foot, weighed by where cosine-distributed rays from a point at `above` arrive.
double gathered(const std::function<double(double)>& irradiance, double above)
{
    constexpr int steps = 400;
    double sum = 0.0;
    for (int i = 0; i < steps; i++) {
        const double u = (i + 0.5) / steps; // of the rays: sin^2 of their angle
        sum += irradiance(above * std::sqrt(u / (1.0 - u))) / steps;
    }
    return sum;
}

// A lamp between a floor and a ceiling, of which the camera sees the middle. What the floor sends up is looked up where gather rays
// arrive: its blur is the bias, that of the lamp's light on the ceiling is none.
TEST(FreshPhotonMaps, BiasOfAGatherIsThatOfWhereItLooks)
{
    constexpr double lamp = 0.3, ceiling = 0.6, radius = 0.1, reflectance = 0.5;
    Scene scene = PointOverPlane{8, 0.02}.scene();
    const float z = static_cast<float>(ceiling);
    scene.shapes.push_back(make_quad({-2, -2, z}, {-2, 2, z}, {2, 2, z}, {2, -2, z}, 0));
    scene.emitters[0].model = PointEmitter{{0, 0, static_cast<float>(lamp)}, {1, 1, 1}};
    scene.sensor.position = {0, 0, 0.1f};
    scene.sensor.axis_z = {0, 0, 1};
    scene.sensor.axis_x = {1, 0, 0};
    const auto irradiance = [&](double rho) { return lamp / std::pow(lamp * lamp + rho * rho, 1.5); };
    const auto blurred = [&](double rho) { // by the Epanechnikov kernel
        constexpr int steps = 24;
        double sum = 0.0;
        for (int i = 0; i < steps; i++)
            for (int k = 0; k < steps; k++) {
                const double t = std::sqrt((i + 0.5) / steps), angle = 2.0 * pi * (k + 0.5) / steps;
                sum += 2.0 * (1.0 - t * t) / (steps * steps) *
                       irradiance(std::hypot(rho + radius * t * std::cos(angle), radius * t * std::sin(angle)));
            }
        return sum;
    };
    const double scale = reflectance * reflectance / pi;
    const double light = scale * gathered(irradiance, ceiling), expected = scale * gathered(blurred, ceiling) - light;
    const RenderRequest r = request("fresh", 16, {{"max_depth", "3"}, {"photons", "16384"}, {"caustic_photons", "1"}, {"radius", "0.1"}});
    const Means means = means_with_errors(scene, r, 6);
    const Estimate bias = estimate_from(means.bias), seen = estimate_from(means.seen);
    const double direct = reflectance / pi / std::pow(ceiling - lamp, 2);
    EXPECT_NEAR(seen.mean, direct + light + expected, student_quantile(5, 0.005) * seen.standard_error);
    EXPECT_NEAR(bias.mean, expected, student_quantile(5, 0.005) * bias.standard_error + 0.15 * std::abs(expected));
    EXPECT_LT(bias.standard_error, 0.05 * std::abs(expected));
}

} // namespace
