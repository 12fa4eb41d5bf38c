// Statistics of progressive methods against their recurrences in double precision, and the small stages that add
// gathered light, light samples and splats.
#include "shared/counted_radius.h"
#include "shared/film.h"
#include "shared/path.h"
#include "shared/photon.h"
#include "support/device_fixture.h"
#include "support/double3.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace sundog
{
namespace
{

constexpr double pi = 3.14159265358979323846;

class ProgressiveStage : public DeviceFixture
{
protected:
    std::mt19937 random_{3};
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    Kernel update_{device_, "update_progressive_pixels", "Update", {{{"SUMS_DIRECT", "1"}}, {}}};
};

// [Hachisuka and Jensen 2009]: N' = N + alpha M, r'^2 = r^2 N' / (N + M), tau' = (tau + beta Phi) r'^2 / r^2.
TEST_F(ProgressiveStage, FollowsTheRecurrence)
{
    constexpr std::size_t pixels = 200;
    constexpr int iterations = 1000;
    constexpr float alpha = 0.7f, inverse_paths = 1.0f / 1024.0f;
    struct Expected {
        double count = 0.0, radius_squared, tau = 0.0, direct = 0.0;
    };
    std::vector<Expected> expected(pixels);
    std::vector<ProgressivePixel> start(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        start[i].radius_squared = uniform(1e-4f, 1e-1f);
        expected[i].radius_squared = start[i].radius_squared;
    }
    const auto device_pixels = upload(start);
    const auto direct_sums = upload(std::vector<DirectSum>(pixels));
    auto queries = allocate<GatherQuery>(pixels);
    auto sums = allocate<GatherSum>(pixels);
    auto radiance = allocate<Vec3>(pixels);
    for (int iteration = 0; iteration < iterations; ++iteration) {
        std::vector<GatherQuery> host_queries(pixels);
        std::vector<GatherSum> host_sums(pixels);
        std::vector<Vec3> host_radiance(pixels), result(pixels);
        for (std::size_t i = 0; i < pixels; ++i) {
            const bool asks = random_() % 8 != 0;
            const float found = random_() % 4 == 0 ? 0.0f : static_cast<float>(random_() % 50);
            host_queries[i].radius = asks ? 0.1f : 0.0f;
            host_queries[i].throughput = {uniform(0, 1), 1, 1};
            host_sums[i] = {{found > 0.0f ? uniform(0, 100) : 0.0f, 0, 0}, found};
            host_radiance[i] = {uniform(0, 10), 1, 1};
            Expected& e = expected[i];
            e.direct += host_radiance[i].x;
            result[i] = host_radiance[i];
            if (!asks || found == 0.0f) continue;
            const double flux = static_cast<double>(host_queries[i].throughput.x) * host_sums[i].flux.x;
            result[i].x += static_cast<float>(flux * inverse_paths / (pi * e.radius_squared));
            const double count = e.count + static_cast<double>(alpha) * found;
            const double shrink = count / (e.count + found);
            e.tau = (e.tau + flux) * shrink;
            e.radius_squared *= shrink;
            e.count = count;
        }
        queries.upload(host_queries);
        sums.upload(host_sums);
        radiance.upload(host_radiance);
        update_(pixels, queries, sums, radiance, static_cast<uint>(pixels), alpha, inverse_paths, 0.0f, device_pixels, direct_sums, radiance);
        if (iteration % 100 != 0) continue;
        const auto got = radiance.download();
        for (std::size_t i = 0; i < pixels; ++i)
            ASSERT_NEAR(got[i].x, result[i].x, 1e-4 * result[i].x) << "radiance of pixel " << i << ", iteration " << iteration;
    }
    const auto got = device_pixels.download();
    const auto direct = direct_sums.download();
    for (std::size_t i = 0; i < pixels; ++i) {
        const Expected& e = expected[i];
        EXPECT_NEAR((static_cast<double>(got[i].count) + got[i].count_error) / e.count, 1.0, 1e-6) << i;
        EXPECT_NEAR((static_cast<double>(direct[i].sum.x) + direct[i].error.x) / e.direct, 1.0, 1e-7) << i;
        // A product of 600 rounded factors.
        EXPECT_NEAR(got[i].radius_squared / e.radius_squared, 1.0, 2e-5) << i;
        EXPECT_NEAR(got[i].tau.x / e.tau, 1.0, 2e-5) << i;
    }
}

// As many photons M in every iteration: N_i = alpha i M, so r_{i+1}^2 / r_i^2 = alpha (i + 1) / (alpha i + 1).
TEST_F(ProgressiveStage, SteadyArrivalsShrinkTheRadiusInClosedForm)
{
    ProgressivePixel pixel{};
    pixel.radius_squared = 1.0f;
    const auto pixels = upload(std::vector{pixel});
    GatherQuery query{};
    query.radius = 1.0f;
    const auto queries = upload(std::vector{query});
    const auto sums = upload(std::vector<GatherSum>{{{1, 1, 1}, 5.0f}});
    const auto radiance = upload(std::vector<Vec3>(1));
    const auto direct_sums = upload(std::vector<DirectSum>(1));
    const float alpha = 2.0f / 3.0f;
    double expected = 1.0;
    for (int i = 0; i < 100; ++i) {
        update_(1, queries, sums, radiance, 1u, alpha, 1.0f, 0.0f, pixels, direct_sums, radiance);
        expected *= static_cast<double>(alpha) * (i + 1) / (static_cast<double>(alpha) * i + 1.0);
    }
    EXPECT_NEAR(pixels.read(0).radius_squared / expected, 1.0, 1e-5);
}

TEST_F(ProgressiveStage, WhatIsNotFiniteStaysOutOfTheStatisticsButIsSeen)
{
    ProgressivePixel pixel{};
    pixel.radius_squared = 0.25f;
    pixel.tau = {1, 1, 1};
    pixel.count = 10.0f;
    const auto pixels = upload(std::vector<ProgressivePixel>(3, pixel));
    GatherQuery query{};
    query.radius = 0.5f;
    query.throughput = {1, 1, 1};
    GatherQuery huge = query;
    huge.throughput = {1e30f, 1, 1};
    const auto queries = upload(std::vector{query, huge, query});
    const auto sums = upload(std::vector<GatherSum>{{{NAN, 1, 1}, 2.0f}, {{1e30f, 1, 1}, 2.0f}, {{1, 1, 1}, 2.0f}});
    const auto radiance = upload(std::vector<Vec3>{{1, 1, 1}, {1, 1, 1}, {INFINITY, 1, 1}});
    const auto direct_sums = upload(std::vector<DirectSum>(3));
    update_(3, queries, sums, radiance, 3u, 0.5f, 1.0f, 0.0f, pixels, direct_sums, radiance);
    const auto got = pixels.download();
    const auto direct = direct_sums.download();
    const auto seen = radiance.download();
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(std::isfinite(got[i].tau.x) && std::isfinite(direct[i].sum.x) && std::isfinite(got[i].radius_squared)) << i;
        EXPECT_FALSE(std::isfinite(seen[i].x)) << "the film could not count it";
    }
    EXPECT_EQ(got[0].count, 10.0f);
    EXPECT_EQ(got[1].radius_squared, 0.25f);
    EXPECT_EQ(direct[2].sum.x, 0.0f);
    EXPECT_EQ(got[2].count, 11.0f);
}

TEST_F(ProgressiveStage, QueriesTakeTheirPixelsRadius)
{
    std::vector<ProgressivePixel> pixels(100);
    std::vector<GatherQuery> queries(100);
    for (uint i = 0; i < 100; ++i) {
        pixels[i].radius_squared = 0.01f * static_cast<float>(i + 1);
        queries[i].radius = i % 5 == 0 ? 0.0f : 7.0f;
    }
    const auto device_queries = upload(queries);
    Kernel(device_, "set_query_radii", "Set radii", BuildOptions{{{"PIXEL_STATISTICS", "ProgressivePixel"}}, {}})(100, upload(pixels), 100u,
                                                                                                                  device_queries);
    const auto got = device_queries.download();
    for (uint i = 0; i < 100; ++i) EXPECT_FLOAT_EQ(got[i].radius, i % 5 == 0 ? 0.0f : std::sqrt(pixels[i].radius_squared)) << i;
}

TEST_F(ProgressiveStage, GatheredLightIsAddedWhereThereIsAQuery)
{
    GatherQuery query{};
    query.radius = 1.0f;
    query.throughput = {0.5f, 1, 2};
    GatherQuery none = query;
    none.radius = 0.0f;
    const auto radiance = upload(std::vector<Vec3>{{1, 2, 3}, {1, 2, 3}});
    Kernel(device_, "add_gathered", "Add")(2, upload(std::vector{query, none}), upload(std::vector<GatherSum>(2, {{8, 16, 32}, 0})), 2u,
                                           0.25f, radiance);
    const auto got = radiance.download();
    EXPECT_EQ(got[0].x, 2.0f);
    EXPECT_EQ(got[0].y, 6.0f);
    EXPECT_EQ(got[0].z, 19.0f);
    EXPECT_EQ(got[1].x, 1.0f);
}

// Only active paths, of those only the ones with a free shadow ray.
TEST_F(ProgressiveStage, UnoccludedLightIsAdded)
{
    const std::vector<uint> active = {7, 2, 5, 0};
    std::vector<uint> occluded(8, 0);
    occluded[2] = 1;
    std::vector<Vec3> light(8);
    for (std::size_t i = 0; i < 8; ++i) light[i] = {static_cast<float>(i), 0.5f, 0};
    const auto radiance = upload(std::vector<Vec3>(8, {10, 0, 0}));
    Kernel(device_, "add_unoccluded", "Add")(8, upload(active), upload(std::vector<uint>{3}), upload(occluded), upload(light), radiance);
    const std::vector<float> expected = {10, 10, 10, 10, 10, 15, 10, 17}; // path 0 lies beyond the count of 3
    const auto got = radiance.download();
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(got[i].x, expected[i]) << i;
}

// The same radii where no flux is kept.
TEST_F(ProgressiveStage, LocalRadiiFollowTheRecurrence)
{
    constexpr uint pixels = 100;
    constexpr float alpha = 0.6f;
    std::vector<double> radius_squared(pixels, 0.25f), counts(pixels, 0.0);
    const auto device_pixels = upload(std::vector<CountedPixel>(pixels, {0.25f, 0, 0}));
    const Kernel shrink(device_, "shrink_radii", "Shrink");
    for (int iteration = 0; iteration < 500; ++iteration) {
        std::vector<GatherQuery> queries(pixels);
        std::vector<GatherSum> sums(pixels);
        for (uint i = 0; i < pixels; ++i) {
            queries[i].radius = random_() % 8 != 0 ? 0.1f : 0.0f;
            sums[i].count = random_() % 4 == 0 ? 0.0f : static_cast<float>(random_() % 50);
            if (queries[i].radius == 0.0f || sums[i].count == 0.0f) continue;
            const double found = sums[i].count, kept = counts[i] + static_cast<double>(alpha) * found;
            radius_squared[i] *= kept / (counts[i] + found);
            counts[i] = kept;
        }
        shrink(pixels, upload(queries), upload(sums), pixels, alpha, device_pixels);
    }
    const auto got = device_pixels.download();
    for (uint i = 0; i < pixels; ++i) {
        EXPECT_NEAR(got[i].count + got[i].count_error, counts[i], 1e-6 * counts[i]) << i;
        EXPECT_NEAR(got[i].radius_squared, radius_squared[i], 500 * 1.2e-7 * radius_squared[i]) << i; // a rounding each time
    }
}

TEST_F(ProgressiveStage, FreeSplatsBecomeDeposits)
{
    const std::vector<uint> active = {3, 1, 0}, occluded = {0, 1, 0, 0};
    const auto flags = upload(std::vector<uint>(3, 77u));
    Kernel(device_, "flag_unoccluded", "Flag")(3, upload(active), upload(std::vector<uint>{3}), upload(occluded), flags);
    EXPECT_EQ(flags.download(), (std::vector<uint>{PATH_DEPOSIT, PATH_ENDED, PATH_DEPOSIT}));
}

// All of a pass in one pixel, as of a collimated beam: 131072 additions would lose a third of a percent in float.
TEST_F(ProgressiveStage, ManyEqualSplatsLoseNothing)
{
    constexpr uint count = 1u << 17;
    std::vector<uint> order(count);
    std::iota(order.begin(), order.end(), 0u);
    const auto radiance = upload(std::vector<Vec3>(1, {0, 0, 0}));
    Kernel(device_, "add_splats", "Add")(1, upload(std::vector<Splat>(count, {{0.1f, 1, 0}, 0u})), upload(order),
                                         upload(std::vector<uint>{count}), 0u, 1u, 1.0f / count, radiance);
    EXPECT_FLOAT_EQ(radiance.read(0).x, 0.1f);
}

// Each pixel's splats are added in the order given.
TEST_F(ProgressiveStage, SplatsAreSummedInOrder)
{
    constexpr uint pixels = 50, count = 3000;
    std::vector<Splat> splats(count);
    for (Splat& splat : splats)
        splat = {{uniform(0, 1) * std::pow(10.0f, uniform(-6, 6)), 1, 0}, static_cast<uint>(random_() % (pixels - 5))};
    std::vector<uint> order(count), ends(pixels, 0);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint a, uint b) { return splats[a].pixel < splats[b].pixel; });
    for (const Splat& splat : splats) ++ends[splat.pixel];
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<uint> padded(13, 4711);
    padded.insert(padded.end(), ends.begin(), ends.end());

    const auto keys = allocate<uint>(count);
    const auto device_splats = upload(splats);
    Kernel(device_, "splat_pixel_keys", "Keys")(count, device_splats, upload(std::vector{count}), keys);
    const auto got_keys = keys.download();
    for (uint i = 0; i < count; ++i) ASSERT_EQ(got_keys[i], splats[i].pixel);

    const auto radiance = upload(std::vector<Vec3>(pixels, {3, 0, 0}));
    Kernel(device_, "add_splats", "Add")(pixels, device_splats, upload(order), upload(padded), 13u, pixels, 0.125f, radiance);
    const auto got = radiance.download();
    for (uint pixel = 0; pixel < pixels; ++pixel) {
        double sum = 0.0;
        uint found = 0;
        for (const Splat& splat : splats)
            if (splat.pixel == pixel) {
                sum += static_cast<double>(splat.radiance.x);
                ++found;
            }
        EXPECT_FLOAT_EQ(got[pixel].x, static_cast<float>(3.0 + sum * 0.125)) << "pixel " << pixel;
        EXPECT_EQ(got[pixel].y, static_cast<float>(found) * 0.125f);
    }
}

} // namespace
} // namespace sundog
