// Metropolis sampling of primary samples: its means depend on none of its parameters, and what no path finds stays black.

#include "methods/method.h"
#include "stages/primary_sample_paths.h"
#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace sundog;
using namespace sundog::test;

namespace
{

constexpr int replicates = 12;

// All pairs, by t tests that together fail in 1% of cases, and each mean known to `precision`.
void expect_equal_means(const Scene& scene, const std::vector<RenderRequest>& requests, double precision)
{
    std::vector<Estimate> estimates;
    for (const RenderRequest& request : requests) estimates.push_back(estimate_image_mean(scene, request, replicates));
    const double pairs = static_cast<double>(requests.size() * (requests.size() - 1)) / 2;
    for (std::size_t a = 0; a < requests.size(); a++) {
        EXPECT_LT(estimates[a].standard_error, precision * allowed_noise() * estimates[a].mean) << "render " << a;
        for (std::size_t b = a + 1; b < requests.size(); b++)
            EXPECT_NEAR(estimates[a].mean, estimates[b].mean,
                        student_quantile(replicates - 1, 0.005 / pairs) *
                            std::hypot(estimates[a].standard_error, estimates[b].standard_error))
                << "renders " << a << " and " << b;
    }
}

// b, and with it the image's brightness, is learned from seeds and large steps; no share of them may show.
TEST(Pssmlt, BrightnessDoesNotDependOnTheShareOfLargeSteps)
{
    std::vector<RenderRequest> requests;
    for (const char* large_step : {"0.05", "0.3", "1"})
        requests.push_back({"pssmlt", 8, {{"large_step", large_step}, {"chains", "4096"}, {"seeds", "32768"}, {"max_depth", "6"}}});
    requests.push_back({"bdpt", 48, {{"max_depth", "6"}}});
    expect_equal_means(glass_box(24), requests, 0.02);
}

// Chains that all start from a handful of seeds, few chains and many.
TEST(Pssmlt, BrightnessDoesNotDependOnChainsAndSeeds)
{
    expect_equal_means(glass_box(16),
                       {{"pssmlt", 32, {{"max_depth", "5"}, {"seeds", "64"}, {"chains", "1024"}}},
                        {"pssmlt", 16, {{"max_depth", "5"}, {"seeds", "4096"}, {"chains", "100"}, {"paths", "path"}}},
                        {"pssmlt", 8, {{"max_depth", "5"}, {"seeds", "8192"}, {"chains", "3000"}}},
                        {"path", 96, {{"max_depth", "5"}}}},
                       0.04);
}

// max_depth counts as in path; paths longer than what chains remember are no less bright.
TEST(Pssmlt, DepthIsBoundedAsInPath)
{
    for (const char* max_depth : {"1", "2", "-1"}) {
        const Scene scene = glass_box(16);
        expect_equal_means(
            scene,
            {{"pssmlt", 6, {{"max_depth", max_depth}, {"chains", "4096"}, {"seeds", "8192"}, {"rr_depth", "20"}, {"paths", "path"}}},
             {"pssmlt", 6, {{"max_depth", max_depth}, {"chains", "4096"}, {"seeds", "8192"}, {"rr_depth", "20"}}},
             {"path", 96, {{"max_depth", max_depth}}}},
            0.03);
    }
}

TEST(Pssmlt, WhatNoPathFindsIsBlack)
{
    Scene scene = cornell_box(16);
    scene.shapes.push_back(make_sphere({0, .99f, 0}, .5f, 0)); // around the light
    for (const char* paths : {"path", "bdpt"}) {
        const Image image = render(scene, {"pssmlt", 2, {{"seeds", "1000"}, {"paths", paths}}}, 1);
        EXPECT_EQ(image_mean(image), 0.0) << paths;
    }
}

// A seed's paths bring the same, to the bit, in whichever chain they are made: a path may know of no chain but its own.
TEST(Pssmlt, WhatAChainContributesDependsOnItsOwnNumbersAlone)
{
    constexpr std::size_t chains = 512;
    const Scene scene = glass_box(16);
    Device& device = shared_device();
    const DeviceScene device_scene(device, scene);
    const Camera camera = make_camera(scene.sensor, scene.film);
    const PixelFilter filter = make_pixel_filter(scene.film.filter);
    for (const auto& make : {make_camera_sample_paths, make_bidirectional_sample_paths}) {
        const auto paths = make(device, device_scene, camera, filter, {chains, 256, {6, 3}});
        PathPool pool(device, device_scene, chains);
        MarkovChains markov_chains(device, {chains, 1, 7, 0.3, 4});
        std::vector<std::vector<float>> found; // by seed, and then by chain
        ASSERT_TRUE(markov_chains.start(chains, [&]() -> const Buffer<float>& {
            const Buffer<float>& contributions = paths->trace(device_scene, pool, markov_chains);
            found.push_back(contributions.download());
            return contributions;
        }));
        ASSERT_EQ(found.size(), 2u);
        std::size_t elsewhere = 0;
        for (std::size_t chain = 0; chain < chains; chain++) {
            ASSERT_GT(found[1][chain], 0.0f);
            ASSERT_NE(std::find(found[0].begin(), found[0].end(), found[1][chain]), found[0].end()) << chain;
            elsewhere += found[0][chain] != found[1][chain];
        }
        EXPECT_GT(elsewhere, chains / 2);
    }
}

// Each of 64 chains mutates four times an iteration, for 256 pixels.
TEST(Pssmlt, CountsItsMutations)
{
    const Scene scene = glass_box(16);
    RenderSettings settings;
    settings.method = "pssmlt";
    settings.parameters = {{"chains", "64"}, {"seeds", "1000"}};
    RenderSession session(scene, shared_device(), settings);
    for (int i = 0; i < 4; i++) session.iterate();
    const MethodCounters counters = session.statistics().counters;
    EXPECT_EQ(counters.mutations, 4u * 64 * 4);
    EXPECT_GT(counters.mutations_accepted, counters.mutations / 4);
    EXPECT_LT(counters.mutations_accepted, counters.mutations);
    EXPECT_EQ(counters.camera_subpaths, counters.mutations + 1000);
    EXPECT_EQ(session.statistics().invalid_samples, 0u);
}

} // namespace
