// What a fixed photon map says of light whose density is known: the mean over the disk (or under the kernel) exactly, and a
// bias that a radius half as large divides by four.

#include "methods/bias_estimate.h"
#include "stages/fixed_photon_map.h"
#include "stages/light_paths.h"
#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <numbers>

using namespace sundog;
using namespace sundog::test;
using std::numbers::pi;

namespace
{

// A point light of intensity 1 at height 1 over a plane.
Scene lamp_over_plane()
{
    Scene scene;
    const uint white = add_bsdf(scene, DiffuseBsdf{{0.5f, 0.5f, 0.5f}});
    scene.shapes.push_back(make_quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, white));
    scene.emitters.push_back({{}, PointEmitter{{0, 0, 1}, {1, 1, 1}}});
    return scene;
}

// As DENSITY_KERNEL, integrating to 1 over the unit disk.
double kernel_value(int kernel, double t)
{
    if (kernel <= 3) return (kernel + 1) / pi * std::pow(1.0 - t * t, kernel);
    if (kernel == 4) return (1.0 - t / 1.1) / (pi * (1.0 - 2.0 / 3.3));
    return 1.728309 / pi * (1.0 - (1.0 - std::exp(-1.953 * t * t / 2.0)) / (1.0 - std::exp(-1.953)));
}

// Mean irradiance under the kernel about the lamp's foot: I h / (h^2 + s^2)^(3/2) at distance s.
double blurred_irradiance(int kernel, double radius)
{
    constexpr int steps = 1000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps, s = t * radius;
        sum += 2.0 * pi * t * kernel_value(kernel, t) / std::pow(1.0 + s * s, 1.5) / steps;
    }
    return sum;
}

TEST(SmoothingKernels, HalfOfTheirSecondMoments)
{
    for (int kernel = 0; kernel < 6; ++kernel) {
        constexpr int steps = 1000;
        double mean = 0.0, squares = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double t = (i + 0.5) / steps, share = 2.0 * pi * t * kernel_value(kernel, t) / steps;
            mean += share;
            squares += share * t * t;
        }
        EXPECT_NEAR(mean, 1.0, 1e-4) << kernel;
        EXPECT_NEAR(half_second_moment(kernel), 0.25 * squares, 1e-5) << kernel; // mu_2 is half of the mean of t^2
    }
}

class LampOverPlane : public testing::Test
{
protected:
    static constexpr std::size_t light_paths = 200'000;
    static constexpr int maps = 12;

    // Of the irradiance at the foot, over maps of different seeds.
    Estimate irradiance(const std::vector<std::vector<Photon>>& photons, const PhotonLookup& lookup)
    {
        std::vector<double> values;
        for (const auto& of_one_map : photons) {
            FixedPhotonMap map(device_, scene_, 1, lookup, of_one_map, light_paths);
            Buffer<GatherQuery> query(device_, std::vector{GatherQuery{{0, 0, 0}, 1.0f, {1, 1, 1}, UNBOUNDED_DEPTH, {0, 0, 1}, 0}},
                                      "query");
            Buffer<Vec3> result(device_, std::vector{Vec3{0, 0, 0}}, "result");
            map.add_radiance(query, Buffer<LobeRecord>(device_, 1, "lobes"), result);
            values.push_back(result.read(0).x);
        }
        return estimate_from(values);
    }

    std::vector<std::vector<Photon>> trace_maps()
    {
        PathPool pool(device_, scene_, light_paths);
        PhotonTracer tracer(device_, scene_, {light_paths, {2, 1}, false, SamplerKind::independent, PhotonsKept::caustic});
        Buffer<Photon> deposits(device_, light_paths, "deposits");
        std::vector<std::vector<Photon>> photons;
        for (std::uint64_t map = 0; map < maps; ++map) {
            const std::size_t stored = tracer.trace(scene_, pool, sampler_key(5, map), deposits);
            photons.push_back(tracer.photons().records().download(0, stored));
        }
        return photons;
    }

    Device& device_ = shared_device();
    DeviceScene scene_{device_, lamp_over_plane()};
};

TEST_F(LampOverPlane, EstimatesAreTheMeanUnderTheKernel)
{
    EXPECT_NEAR(blurred_irradiance(0, 0.5), 2.0 / 0.25 * (1.0 - 1.0 / std::sqrt(1.25)), 1e-5)
        << "the disk's mean, (2 I h / r^2)(1 / h - 1 / sqrt(h^2 + r^2))";
    const auto photons = trace_maps();
    const double quantile = student_quantile(maps - 1, 0.005 / 7);
    for (int kernel = 0; kernel < 6; ++kernel) {
        const Estimate found = irradiance(photons, {0.5f, 0, 0.5f, kernel});
        EXPECT_NEAR(found.mean, blurred_irradiance(kernel, 0.5), quantile * found.standard_error) << "kernel " << kernel;
        EXPECT_LT(found.standard_error, 0.005) << "kernel " << kernel;
    }
    // k nearest photons: about as many as within the radius where the density at the foot holds them.
    const Estimate nearest = irradiance(photons, {2.0f, 2000, 0.1f, 0});
    const double radius = std::sqrt(2000.0 / (pi * light_paths / (4.0 * pi))); // where the density at the foot would hold
    EXPECT_NEAR(nearest.mean, blurred_irradiance(0, radius), quantile * nearest.standard_error + 0.002);
}

// To third order: the closed form's own ratio for r = 1/2 is 3.5. A relative error of 1% of the bias is one of 0.15% of the light.
TEST_F(LampOverPlane, HalvingTheRadiusDividesTheBiasByFour)
{
    const auto photons = trace_maps();
    const Estimate wide = irradiance(photons, {0.5f, 0, 0.5f, 0}), half = irradiance(photons, {0.25f, 0, 0.25f, 0});
    const double wide_bias = 1.0 - wide.mean, half_bias = 1.0 - half.mean;
    const double expected = (1.0 - blurred_irradiance(0, 0.5)) / (1.0 - blurred_irradiance(0, 0.25));
    EXPECT_NEAR(expected, 3.5, 0.05);
    const double error = half.standard_error / half_bias + wide.standard_error / wide_bias; // relative, of the ratio
    EXPECT_NEAR(wide_bias / half_bias, expected, 3.0 * error * expected);
    EXPECT_LT(error, 0.12);
}

// Irradiance read where it was computed instead of looked up where rays arrive: the same light, displaced by at most a photon's
// distance, with the same seed and so the same noise of maps and rays.
TEST(PrecomputedIrradiance, IsTheSameLight)
{
    const Scene scene = cornell_box(24);
    const auto mean = [&](const char* precompute, std::uint64_t seed) {
        return image_mean(render(scene, {"photonmapper", 8, {{"precompute", precompute}, {"photons", "20000"}, {"radius", "0.1"}}}, seed));
    };
    std::vector<double> ratios;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) ratios.push_back(mean("true", seed) / mean("false", seed));
    const Estimate ratio = estimate_from(ratios);
    // Places in the corners are of photons on both walls, whose disks lose their light as those of the lookups do.
    EXPECT_NEAR(ratio.mean, 1.0, 0.01);
    EXPECT_LT(ratio.standard_error, 0.003);
    EXPECT_NE(ratios[0], 1.0);
}

// A camera that sees a corner of the box: fewer photons stay, and the light is the same in the mean.
TEST(Importons, KeepTheMeanWithFewerPhotons)
{
    Scene scene = cornell_box(16);
    scene.shapes.push_back(make_sphere({-.5f, -.6f, -.4f}, .3f, add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}})));
    scene.sensor.position = {-.4f, -.5f, .3f};
    scene.sensor.fov_x = .6f;
    for (const char* final_gather : {"true", "false"}) {
        RenderRequest all{"photonmapper",
                          8,
                          {{"photons", "8192"},
                           {"radius", "0.1"},
                           {"caustic_radius", "0.05"},
                           {"final_gather", final_gather},
                           {"sampler", "independent"}}};
        RenderRequest important = all;
        important.parameters["importons"] = "2000";
        const Estimate x = estimate_image_mean(scene, all, 16), y = estimate_image_mean(scene, important, 16);
        const double error = std::hypot(x.standard_error, y.standard_error);
        EXPECT_NEAR(x.mean, y.mean, student_quantile(15, 0.005 / 2) * error);
        EXPECT_LT(error, 0.04 * allowed_noise() * x.mean);
        const auto stored = [&](const RenderRequest& request) {
            RenderSettings settings;
            settings.method = "photonmapper";
            settings.parameters = request.parameters;
            settings.seed = 1;
            RenderSession session(scene, shared_device(), settings);
            return static_cast<double>(session.statistics().counters.photons_stored);
        };
        EXPECT_LT(stored(important), (final_gather[0] == 't' ? 0.9 : 0.5) * stored(all)) << final_gather;
    }
}

// With light reflected at most so often, in a ball that is lit all over: L_e (1 - rho^D) / (1 - rho).
TEST(FixedMapSeries, DepthBoundCutsTheSeries)
{
    for (const bool final_gather : {true, false}) {
        for (int depth : {0, 1, 2, 3, 4}) {
            const RenderRequest request{"photonmapper",
                                        8,
                                        {{"max_depth", std::to_string(depth)},
                                         {"sampler", "independent"},
                                         {"radius", "0.1"},
                                         {"photons", "16384"},
                                         {"final_gather", final_gather ? "true" : "false"}}};
            const Estimate estimate = estimate_image_mean(load_test_scene("analytic/sphere-furnace.xml"), request, 8);
            const double answer = (1.0 - std::pow(0.8, depth)) / (1.0 - 0.8);
            EXPECT_NEAR(estimate.mean, answer, student_quantile(7, 0.005 / 10) * estimate.standard_error + 3e-4 * answer + 2e-5) << depth;
            EXPECT_LE(estimate.standard_error, 0.015 * answer);
        }
    }
}

} // namespace
