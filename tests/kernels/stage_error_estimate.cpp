// Estimates of errors: Laplacians and bias where both are known, the stages against plain C++, and who may not ask.
#include "base/errors.h"
#include "film/device_film.h"
#include "render/session.h"
#include "shared/adaptive_radius.h"
#include "support/device_fixture.h"
#include "support/photon_cloud.h"
#include "support/render_replicates.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace sundog
{
namespace
{

class ErrorStage : public DeviceFixture
{
protected:
    // Bias over radiance of lookups of the k nearest photons of even light; mean over queries, by cloud.
    test::Estimate nearest_bias(uint k, float largest, const std::string& estimator)
    {
        constexpr std::size_t photon_count = 40'000, query_count = 2000;
        constexpr float density = photon_count, half_moment = 1.0f / 12.0f; // of the Epanechnikov kernel
        const BuildOptions nearest{{{"NEAREST", std::to_string(k) + "u"}}, {}};
        const Kernel find(device_, "find_nearest_radii", "Nearest", nearest);
        PhotonCloud cloud(device_, {{0, 0, -1}, {1, 1, 1}}, photon_count);
        PhotonGather<LaplacianSum> laplacians(device_, query_count, estimator, 0, {}, true);
        const uint count = query_count;
        std::vector<double> means;
        for (int i = 0; i < 12; i++) {
            std::vector<Photon> photons;
            for (std::size_t j = 0; j < photon_count; j++)
                photons.push_back(make_test_photon({uniform(0, 1), uniform(0, 1), 0}, {1, 1, 1}));
            cloud.build_dense(photons, 0.01f);
            std::vector<GatherQuery> asked;
            for (std::size_t j = 0; j < query_count; j++)
                asked.push_back(make_test_query({uniform(0.1f, 0.9f), uniform(0.1f, 0.9f), 0}, 1.0f));
            const auto queries = upload(asked);
            find(count, cloud.map, 0.01f, largest, count,
                 queries);
            auto wide = allocate<GatherQuery>(query_count);
            widen_(count, queries, count, 0.0f, NARROWEST_LAPLACIAN, wide);
            laplacians.gather(cloud.map, wide, Buffer<LobeRecord>(device_, 1, "lobes"), query_count);
            const auto bias = upload(std::vector<Vec3>(query_count, {0, 0, 0}));
            add_bias_(count, queries, laplacians.sums, count, half_moment, bias);
            double sum = 0.0;
            for (const Vec3& value : bias.download()) sum += value.x;
            means.push_back(sum / (density * query_count));
        }
        return test::estimate_from(means);
    }

    std::mt19937 random_{5};
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    BuildOptions laplacian_sum_{{{"LAPLACIAN_SUM", "LaplacianSum"}}, {}};
    Kernel widen_{device_, "widen_queries", "Widen"};
    Kernel add_bias_{device_, "add_bias", "Add bias", laplacian_sum_};
};

// Irradiance a + b x + c x^2 + d y^2 + e x y: its Laplacian is 2 (c + d) for any radius of its own, and an estimate by a
// kernel of any shape and radius is wrong by mu_2 r^2 (c + d), exactly.
TEST_F(ErrorStage, BiasOfAParaboloidIsExact)
{
    constexpr int side = 600;
    std::vector<Photon> photons;
    for (int i = 0; i < side; i++)
        for (int k = 0; k < side; k++) {
            const double x = 2.0 * (i + 0.5) / side - 1.0, y = 2.0 * (k + 0.5) / side - 1.0, cell = 4.0 / (side * side);
            const double curved = 3.0 + 0.7 * x + 1.5 * x * x - 0.4 * y * y + 2.0 * x * y, saddle = 2.0 + x * x - y * y;
            photons.push_back(make_test_photon(to_float(Vec3d(x, y, 0)), {static_cast<float>(curved * cell), static_cast<float>(cell),
                                                                          static_cast<float>(saddle * cell)}));
        }
    PhotonCloud cloud(device_, {{-1, -1, -1}, {1, 1, 1}}, photons.size());
    cloud.build(photons, 0.9f);
    const float radius = 0.4f;
    GatherQuery query = make_test_query({0, 0, 0}, radius);
    query.throughput = {0.5f, 1.0f, 2.0f};
    const Vec3d truth(3.0, 1.0, 2.0);

    const auto queries = upload(std::vector{query});
    auto wide = allocate<GatherQuery>(1);
    widen_(1, queries, 1u, 0.5f, 2.0f, wide); // twice its own radius is more
    ASSERT_EQ(wide.read(0).radius, 0.8f);
    PhotonGather<LaplacianSum> laplacians(device_, 1, "estimators/laplacian.h", 0);
    const LaplacianSum sum = cloud.gather(laplacians, wide.download())[0];
    // What is left is the midpoint rule's error on the disk's rim.
    EXPECT_NEAR(sum.laplacian.x, 2 * (1.5 - 0.4), 0.02);
    EXPECT_NEAR(sum.laplacian.y, 0.0, 0.005);
    EXPECT_NEAR(sum.laplacian.z, 0.0, 0.01);

    for (int n = 0; n <= 3; n++) {
        SCOPED_TRACE(n);
        PhotonGather<> radiance(device_, 1, "estimators/radiance_estimate.h", n);
        const GatherSum gathered = cloud.gather(radiance, {query})[0];
        const auto bias = upload(std::vector<Vec3>{{0.25f, 0, 0}}); // which there was before
        add_bias_(1, queries, laplacians.sums, 1u, 0.25f / (static_cast<float>(n) + 2.0f), bias);
        const Vec3 got = bias.read(0);
        EXPECT_NEAR(got.x - 0.25, query.throughput.x * (gathered.flux.x - truth.x), 1e-3);
        EXPECT_NEAR(got.y, query.throughput.y * (gathered.flux.y - truth.y), 1e-3);
        EXPECT_NEAR(got.z, query.throughput.z * (gathered.flux.z - truth.z), 2e-3);
        EXPECT_GT(got.x - 0.25, 0.5 * 1.1 * radius * radius / (2.0 * (n + 2)) * 0.97);
    }
}

// Even light has no bias. The k-th photon, which always lies at r_k, would make one: with h = 3/2 r_k the mean of mu_2 / 2 r_k^2 Delta
// is 1/12 48 / h^4 (1 - 4/9) (3 4/9 - 1) r_k^2 / (pi r_k^2) = 0.146 / (k - 1) of the light.
TEST_F(ErrorStage, RadiiOfNearestPhotonsMakeNoBias)
{
    const double quantile = test::student_quantile(11, 0.005 / 5);
    for (const uint k : {10u, 40u}) {
        SCOPED_TRACE(k);
        const test::Estimate bias = nearest_bias(k, 0.2f, "estimators/nearest_laplacian.h");
        EXPECT_NEAR(bias.mean, 0.0, quantile * bias.standard_error);
        EXPECT_LT(quantile * bias.standard_error, 0.1 / (k - 1));
        const test::Estimate with_kth = nearest_bias(k, 0.2f, "estimators/laplacian.h");
        EXPECT_NEAR(with_kth.mean, 0.146 / (k - 1), quantile * with_kth.standard_error);
    }
    // Within half of the radius that holds ten, where no photon lies at the rim.
    const test::Estimate few = nearest_bias(10, 0.0045f, "estimators/nearest_laplacian.h");
    EXPECT_NEAR(few.mean, 0.0, quantile * few.standard_error);
    EXPECT_LT(quantile * few.standard_error, 0.02);
}

TEST_F(ErrorStage, WidensAndAddsWhereThereIsAQuery)
{
    constexpr std::size_t count = 500;
    std::vector<GatherQuery> queries(count);
    std::vector<LaplacianSum> laplacians(count);
    std::vector<Vec3> before(count);
    for (std::size_t i = 0; i < count; i++) {
        queries[i].radius = i % 5 == 0 ? 0.0f : uniform(0.01f, 1.0f);
        queries[i].throughput = {uniform(0, 1), uniform(0, 1), uniform(0, 1)};
        queries[i].flags = static_cast<uint>(i);
        laplacians[i].laplacian = {uniform(-9, 9), uniform(-9, 9), i % 7 == 0 ? INFINITY : uniform(-9, 9)};
        before[i] = {uniform(0, 1), 0, 0};
    }
    const auto wide = allocate<GatherQuery>(count);
    const auto bias = upload(before);
    widen_(count, upload(queries), static_cast<uint>(count), 0.3f, 1.5f, wide);
    add_bias_(count, upload(queries), upload(laplacians), static_cast<uint>(count), 0.125f, bias);
    const auto widened = wide.download();
    const auto got = bias.download();
    for (std::size_t i = 0; i < count; i++) {
        const float r = queries[i].radius;
        EXPECT_EQ(widened[i].radius, r == 0.0f ? 0.0f : std::max(0.3f, 1.5f * r));
        EXPECT_EQ(widened[i].flags, i);
        const bool counts = r > 0.0f && i % 7 != 0;
        EXPECT_NEAR(got[i].x, before[i].x + (counts ? 0.125f * r * r * queries[i].throughput.x * laplacians[i].laplacian.x : 0.0f), 1e-5f)
            << i;
        EXPECT_NEAR(got[i].y, counts ? 0.125f * r * r * queries[i].throughput.y * laplacians[i].laplacian.y : 0.0f, 1e-5f) << i;
    }
}

// Of one channel of one pixel: what iterations brought, and the bias in it.
struct History {
    std::vector<double> seen, bias;
    double mean() const { return std::accumulate(seen.begin(), seen.end(), 0.0) / static_cast<double>(seen.size()); }
    double mean_bias() const { return std::accumulate(bias.begin(), bias.end(), 0.0) / static_cast<double>(bias.size()); }
    double standard_error_without_bias() const
    {
        const double n = static_cast<double>(seen.size());
        double squares = 0.0;
        for (std::size_t i = 0; i < seen.size(); i++) squares += std::pow(seen[i] - bias[i] - mean() + mean_bias(), 2);
        return std::sqrt(squares / (n - 1) / n);
    }
};

// Pixels of every kind: dark and bright, noise of the size of the value and a thousandth of it, bias that varies.
TEST_F(ErrorStage, BoundsAreThoseOfPlainStatistics)
{
    constexpr int width = 16, height = 12, iterations = 300;
    for (const double confidence : {0.5, 0.9}) {
        DeviceFilm film(device_, width, height);
        film.errors.emplace(device_, film.pixel_count(), true, confidence);
        std::vector<History> history(3 * film.pixel_count());
        for (int i = 0; i < iterations; i++) {
            std::vector<Vec3> radiance(film.pixel_count()), bias(film.pixel_count());
            for (std::size_t path = 0; path < radiance.size(); path++) {
                const float level = std::pow(10.0f, static_cast<float>(path % 5) - 2.0f), noise = path % 2 == 0 ? level : 1e-3f * level;
                radiance[path] = {level + uniform(-noise, noise), uniform(0, level), path % 3 == 0 ? 0.0f : level};
                bias[path] = {uniform(-noise, 2 * noise), uniform(0, 0.2f) * radiance[path].y, 0.0f};
                const float seen[3] = {radiance[path].x, radiance[path].y, radiance[path].z},
                            wrong[3] = {bias[path].x, bias[path].y, bias[path].z};
                for (std::size_t c = 0; c < 3; c++) {
                    history[3 * path + c].seen.push_back(seen[c]);
                    history[3 * path + c].bias.push_back(wrong[c]);
                }
            }
            film.errors->bias.upload(bias);
            film.accumulate(upload(radiance));
        }
        for (const Vec3& left : film.errors->bias.download()) EXPECT_EQ(left.x, 0.0f);

        const Image image = film.resolve();
        ASSERT_THAT(image.channels, testing::IsSupersetOf({"error.R", "error.G", "error.B", "bias.R", "bias.G", "bias.B"}));
        const double quantile = test::student_quantile(iterations - 1, 0.5 * (1 - confidence));
        double bounds = 0, biases = 0;
        for (std::size_t path = 0; path < film.pixel_count(); path++) {
            const float* pixel = &image.pixels[film.pixel_of_path(path) * image.channels.size()];
            for (std::size_t c = 0; c < 3; c++) {
                const History& h = history[3 * path + c];
                const double bound = std::abs(h.mean_bias()) + quantile * h.standard_error_without_bias(), scale = h.mean() + 1e-3;
                EXPECT_NEAR(pixel[13 + c], bound, 1e-4 * bound + 3e-7 * scale) << "error of " << path << ", channel " << c;
                EXPECT_NEAR(pixel[16 + c], h.mean_bias(), 1e-4 * std::abs(h.mean_bias()) + 3e-7 * scale) << "bias of " << path;
                bounds += bound * bound / (h.mean() * h.mean() + 0.01);
                biases += h.mean_bias() * h.mean_bias() / (h.mean() * h.mean() + 0.01);
            }
        }
        const double values = 3.0 * width * height;
        EXPECT_NEAR(relative_bound(image), std::sqrt(bounds / values), 1e-4 * std::sqrt(bounds / values));
        const RelativeError error = film.relative_error();
        EXPECT_NEAR(error.bound, std::sqrt(bounds / values), 1e-4 * std::sqrt(bounds / values));
        EXPECT_NEAR(error.bias, std::sqrt(biases / values), 1e-4 * std::sqrt(biases / values));
    }
}

// The reduction works in single precision: a thousand iterations whose noise is a hundred-thousandth of the value.
TEST_F(ErrorStage, TinyNoiseOfBrightPixelsIsNotLost)
{
    constexpr int iterations = 1000;
    constexpr float level = 16.0f, noise = 1.0f / 4096.0f; // both sums are exact
    DeviceFilm film(device_, 8, 8);
    film.errors.emplace(device_, 64, false, 0.9);
    for (int i = 0; i < iterations; i++) {
        const float value = level + (i % 2 == 0 ? noise : -noise);
        film.accumulate(upload(std::vector<Vec3>(64, {value, value, value})));
    }
    const double standard_error = noise / std::sqrt(iterations - 1.0);
    EXPECT_NEAR(film.relative_error().noise / (standard_error / std::sqrt(level * level + 0.01)), 1.0, 0.01);
    EXPECT_EQ(film.relative_error().bias, 0.0);
}

TEST_F(ErrorStage, WhatIsNotFiniteIsLeftOutOfBoth)
{
    DeviceFilm film(device_, 2, 1);
    film.errors.emplace(device_, 2, true, 0.9);
    for (int i = 0; i < 8; i++) {
        film.errors->bias.upload(std::vector<Vec3>{{0.5f, 0, 0}, {0.5f, 0, 0}});
        film.accumulate(upload(std::vector<Vec3>{{3, 3, 3}, {i == 4 ? NAN : 3.0f, 3, 3}}));
    }
    EXPECT_EQ(film.invalid_samples(), 1u);
    for (const float value : film.resolve().pixels) EXPECT_TRUE(std::isfinite(value));
}

TEST_F(ErrorStage, OneIterationHasNoBound)
{
    DeviceFilm film(device_, 2, 1);
    film.errors.emplace(device_, 2, false, 0.9);
    film.accumulate(upload(std::vector<Vec3>(2, {1, 1, 1})));
    EXPECT_TRUE(std::isinf(film.relative_error().bound));
    EXPECT_TRUE(std::isinf(film.resolve().pixels[13]));
    film.accumulate(upload(std::vector<Vec3>(2, {1, 1, 1})));
    EXPECT_EQ(film.relative_error().bound, 0.0);
}

// A method that says nothing of its errors.
class Blind final : public Method
{
public:
    void render_pass(std::uint64_t) override {}
    MethodCounters counters() const override { return {}; }
    void serialize(StateArchive&) override {}
};

const MethodRegistration
    blind({.name = "blind",
           .title = "",
           .paper = "",
           .estimator_class = "unbiased",
           .description = "",
           .parameters = {},
           .create = [](RenderContext&, const Parameters&) -> std::unique_ptr<Method> { return std::make_unique<Blind>(); }});

TEST_F(ErrorStage, MethodsThatCannotAreRefusedByName)
{
    RenderSettings settings;
    settings.method = "blind";
    const Scene scene = test::load_test_scene("analytic/furnace.xml");
    EXPECT_NO_THROW(RenderSession(scene, device_, settings));
    settings.errors = ErrorSettings{};
    try {
        RenderSession session(scene, device_, settings);
        FAIL() << "accepted";
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(),
                    testing::HasSubstr(
                        "blind cannot estimate its error; choose one of appm, bdpt, cppm, path, photonmapper, ppm, pppm, ptracer, sppm"));
    }
}

} // namespace
} // namespace sundog
