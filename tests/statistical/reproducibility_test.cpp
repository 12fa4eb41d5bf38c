// The same scene, seed, method and device give the same bits, however the work is divided.

#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

using namespace sundog;
using namespace sundog::test;

namespace {

Scene glass_box_by_wide_filter()
{
    Scene scene = glass_box(48);
    scene.film.filter = {FilterKind::gaussian, 2.0f, 0.5f, 0, 0};
    return scene;
}

class Reproducibility : public testing::TestWithParam<std::string> {
protected:
    Image render_with_groups(std::size_t work_group_size, std::uint64_t seed)
    {
        Device device(select_device(""));
        device.set_work_group_size(work_group_size);
        RenderSettings settings;
        settings.method = GetParam();
        settings.seed = seed;
        RenderSession session(glass_box_by_wide_filter(), device, settings);
        for (int i = 0; i < 5; i++) session.iterate();
        return session.image();
    }
};

TEST_P(Reproducibility, SameSeedSameBits)
{
    EXPECT_EQ(render_with_groups(64, 7).pixels, render_with_groups(64, 7).pixels);
}

TEST_P(Reproducibility, WorkGroupSizeDoesNotMatter)
{
    EXPECT_EQ(render_with_groups(64, 7).pixels, render_with_groups(16, 7).pixels);
}

TEST_P(Reproducibility, AnotherSeedAnotherImage)
{
    EXPECT_NE(render_with_groups(64, 7).pixels, render_with_groups(64, 8).pixels);
}

INSTANTIATE_TEST_SUITE_P(Methods, Reproducibility, testing::Values("path", "ptracer", "pppm", "sppm", "cppm", "ppm", "appm", "photonmapper", "bdpt", "vcm", "upg", "psr", "pssmlt"), [](const auto& method) { return method.param; });

} // namespace
