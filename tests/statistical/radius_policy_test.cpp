// Radius policies as parts that any averaging method takes: a name is a choice of them; what they learn outlives an interruption.
#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <unistd.h>

namespace sundog::test
{
namespace
{

// Tests are frequent, and radii wide, so that policies come to act within a few iterations.
RenderRequest request(const std::string& method, const std::string& policy, const std::string& kernel)
{
    RenderRequest r{method, 6, {{"radius", "0.2"}, {"radius_policy", policy}, {"kernel", kernel}}};
    if (policy == "chi_squared") r.parameters["first_test"] = "12";
    return r;
}

class RadiusPolicies : public testing::TestWithParam<std::string>
{
};

TEST_P(RadiusPolicies, AreTheSameInEveryMethod)
{
    const auto pixels = [&](const std::string& method) { return render(glass_box(24), request(method, GetParam(), "biweight"), 3).pixels; };
    const auto by_pppm = pixels("pppm");
    EXPECT_EQ(pixels("appm"), by_pppm);
    EXPECT_EQ(pixels("cppm"), by_pppm);
    if (GetParam() != "local") {
        EXPECT_EQ(pixels("sppm"), by_pppm);
    }
}

TEST_P(RadiusPolicies, DifferFromAFixedRadius)
{
    const auto image = [](const std::string& policy) { return render(glass_box(24), request("pppm", policy, "uniform"), 3).pixels; };
    if (GetParam() != "fixed") {
        EXPECT_NE(image(GetParam()), image("fixed"));
    }
}

TEST_P(RadiusPolicies, ResumedIsUninterrupted)
{
    const auto folder = std::filesystem::temp_directory_path() / ("sundog_policy_" + std::to_string(getpid()) + GetParam());
    std::filesystem::create_directories(folder);
    const RenderRequest r = request("pppm", GetParam(), "epanechnikov");
    RenderSettings settings;
    settings.method = r.method;
    settings.parameters = r.parameters;
    settings.seed = 5;
    const auto iterate = [](RenderSession& session, int count) {
        for (int i = 0; i < count; i++) session.iterate();
    };
    RenderSession first(glass_box(24), shared_device(), settings), second(glass_box(24), shared_device(), settings),
        whole(glass_box(24), shared_device(), settings);
    iterate(first, 4);
    first.save_checkpoint(folder / "c");
    second.resume(folder / "c");
    iterate(second, 4);
    iterate(whole, 8);
    EXPECT_EQ(second.image().pixels, whole.image().pixels);
    std::filesystem::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(All, RadiusPolicies, testing::Values("fixed", "schedule", "local", "adaptive", "chi_squared"),
                         [](const auto& policy) { return policy.param; });

// The flux that sppm rescales is not the mean of iterations.
TEST(RadiusPolicy, SppmRescalesFlux)
{
    EXPECT_NE(render(glass_box(24), request("sppm", "local", "uniform"), 3).pixels,
              render(glass_box(24), request("pppm", "local", "uniform"), 3).pixels);
}

} // namespace
} // namespace sundog::test
