// Lights that the camera does not see, and extremes of what a scene may say.
#include "support/render_replicates.h"

#include <gtest/gtest.h>

using namespace sundog;
using namespace sundog::test;

namespace
{

constexpr int replicates = 8;

Scene scene_of_tests(const std::string& name, const std::map<std::string, std::string>& defines = {})
{
    return load_scene(source_folder() / "tests/scenes" / name, {defines}).scene;
}

// All pixels of v3-hidden-furnace.xml are 0.5. bias: what a method may be off by itself.
void expect_hidden(const RenderRequest& request, double bias = 0.0)
{
    SCOPED_TRACE(request.method);
    const Scene scene = scene_of_tests("v3-hidden-furnace.xml");
    const auto [mean, error] = estimate_image_mean(scene, request, replicates);
    EXPECT_LT(error, 0.02) << "the test must be able to fail";
    EXPECT_NEAR(mean, 0.5, 6.0 * error + bias); // 6 of Student's t with 7 degrees: once in 2000
}

TEST(HiddenEmitters, CameraSeesPastThem)
{
    expect_hidden({"path", 32, {}});
    expect_hidden({"bdpt", 32, {}});
}

TEST(LongHiddenEmitters, EveryMethodSeesPastThem)
{
    for (const char* method : {"psr", "vcm", "upg", "pssmlt"}) expect_hidden({method, 64, {}}, 0.005);
    for (const char* method : {"ptracer", "bpm", "ppm", "sppm", "pppm", "appm", "cppm", "photonmapper"})
        expect_hidden({method, 64, {{"photons", "20000"}}}, 0.02);
}

// Where nothing is in the way but what lets light straight through.
TEST(HiddenEmitters, EnvironmentIsNotSeenThroughNull)
{
    Scene scene = scene_of_tests("v3-environment-behind-null.xml");
    EXPECT_EQ(image_mean(render(scene, {"path", 4, {}}, 1)), 0.0);
    scene.integrator.hide_emitters = false;
    EXPECT_NEAR(image_mean(render(scene, {"path", 4, {}}, 1)), 1.0, 1e-5);
}

TEST(ExtremeValues, NoChannelHasANan)
{
    for (const char* fov : {"40", "1.2e-5", "179.9"}) {
        const Image image = render(scene_of_tests("v3-extreme-values.xml", {{"fov", fov}}), {"path", 2, {}}, 1);
        for (std::size_t i = 0; i < image.pixels.size(); i++)
            ASSERT_TRUE(std::isfinite(image.pixels[i])) << "fov " << fov << ", channel " << image.channels[i % image.channels.size()];
    }
}

} // namespace
