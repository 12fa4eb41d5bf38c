// photonmapper with progressive relaxation: the same mean as pppm, less noise with each iteration from a map that stays
// as small, and the same bits after a resumption.
#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <unistd.h>

using namespace sundog;
using namespace sundog::test;

namespace
{

RenderRequest request(const std::string& method, std::uint64_t iterations, const std::map<std::string, std::string>& more = {})
{
    RenderRequest r{method, iterations, {{"max_depth", "-1"}, {"sampler", "independent"}}};
    for (const auto& [name, value] : more) r.parameters[name] = value;
    return r;
}

const std::map<std::string, std::string> progressive{{"photons", "4096"}, {"radius", "0.05"}, {"relaxation_progressive", "true"}};

// The bias is that of the box's edges, 2 r 0.21 as in agreement_test.cpp, seen after one reflection: 1% for r = 0.05.
TEST(ProgressiveRelaxation, MeanIsThatOfPppm)
{
    constexpr int replicates = 8;
    const Scene scene = glass_box(16);
    const Estimate pppm = estimate_lower_half(scene, request("pppm", 16, {{"photons", "4096"}, {"radius", "0.02"}}), replicates);
    const Estimate relaxed = estimate_lower_half(scene, request("photonmapper", 8, progressive), replicates);
    const double error = std::hypot(pppm.standard_error, relaxed.standard_error);
    EXPECT_NEAR(relaxed.mean, pppm.mean, student_quantile(replicates - 1, 0.005) * error + 0.01 * pppm.mean);
    EXPECT_LT(error, 0.02 * allowed_noise() * pppm.mean);
}

// All light by photons that are looked up at once. The image is the mean of those of all iterations' maps, so that the noise of
// the first still shows. 1536 values, whose deviation has a relative error of 2%, were .60, .13, .30 and .25.
TEST(ProgressiveRelaxation, NoiseFallsWithIterations)
{
    const Scene scene = cornell_box(16);
    std::map<std::string, std::string> parameters = progressive;
    parameters["direct"] = "photons";
    parameters["final_gather"] = "false";
    parameters["caustic_photons"] = "4096";
    parameters["caustic_radius"] = "0.05";
    const auto noise_of = [&](const RenderRequest& r) { return relative_noise(scene, r, scene.film.height / 2); };
    const double few = noise_of(request("photonmapper", 2, parameters)),
                 many = noise_of(request("photonmapper", 24, parameters));
    parameters["relaxation_progressive"] = "false";
    const double fixed = noise_of(request("photonmapper", 24, parameters));
    const double sppm = noise_of(request("sppm", 24, {{"photons", "4096"}, {"radius", "0.05"}, {"direct", "photons"}}));
    EXPECT_LT(many, 0.4 * few);
    EXPECT_LT(many, 0.6 * fixed);
    EXPECT_LT(many, 0.8 * sppm) << "whose radii shrink";
}

TEST(ProgressiveRelaxation, ResumedIsUninterrupted)
{
    const auto file = std::filesystem::temp_directory_path() / ("sundog-progressive-" + std::to_string(::getpid()));
    RenderSettings settings;
    settings.method = "photonmapper";
    settings.parameters = request("photonmapper", 0, progressive).parameters;
    settings.parameters["relaxation"] = "3";
    settings.seed = 7;
    RenderSession whole(glass_box(19), shared_device(), settings);
    for (int i = 0; i < 2; i++) whole.iterate();
    whole.save_checkpoint(file);
    for (int i = 0; i < 3; i++) whole.iterate();
    RenderSession resumed(glass_box(19), shared_device(), settings);
    resumed.resume(file);
    for (int i = 0; i < 3; i++) resumed.iterate();
    std::filesystem::remove(file);
    EXPECT_TRUE(resumed.image().pixels == whole.image().pixels);
    EXPECT_EQ(resumed.statistics().counters.photons_stored, whole.statistics().counters.photons_stored);
    EXPECT_EQ(resumed.statistics().counters.rays, whole.statistics().counters.rays);
}

} // namespace
