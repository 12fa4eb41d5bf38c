// The same scene, seed, method and device give the same bits, however the work is divided.

#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace sundog;
using namespace sundog::test;

namespace {

Scene glass_box_by_wide_filter()
{
    Scene scene = glass_box(48);
    scene.film.filter = {FilterKind::gaussian, 2.0f, 0.5f, 0, 0};
    return scene;
}

const std::vector<std::string> methods = {"path", "ptracer", "pppm", "sppm", "cppm", "ppm", "appm", "photonmapper", "bdpt", "vcm", "upg", "psr", "pssmlt"};

class Reproducibility : public testing::TestWithParam<std::string> {
protected:
    std::vector<float> render_with_groups(std::size_t work_group_size, std::uint64_t seed)
    {
        Device device(select_device(""));
        device.set_work_group_size(work_group_size);
        RenderSettings settings;
        settings.method = GetParam();
        settings.seed = seed;
        RenderSession session(glass_box_by_wide_filter(), device, settings);
        for (int i = 0; i < 5; i++) session.iterate();
        return session.image().pixels;
    }
};

TEST_P(Reproducibility, SameSeedSameBits)
{
    const std::vector<float> pixels = render_with_groups(256, 7);
    EXPECT_TRUE(render_with_groups(256, 7) == pixels);
    EXPECT_FALSE(render_with_groups(256, 8) == pixels) << "another seed makes the same image";
}

INSTANTIATE_TEST_SUITE_P(Methods, Reproducibility, testing::ValuesIn(methods), [](const auto& method) { return method.param; });

// Apart, since every kernel is compiled once more for groups of another size.
class WorkGroups : public Reproducibility {};

TEST_P(WorkGroups, SizeDoesNotMatter)
{
    EXPECT_TRUE(render_with_groups(256, 7) == render_with_groups(64, 7));
}

// Of each kind one: hit points and photons, subpaths and merging, chains, final gathering. The others' own kernels wait for the long tier.
const std::vector<std::string> telling_methods = {"sppm", "vcm", "pssmlt", "photonmapper"};

std::vector<std::string> other_methods()
{
    std::vector<std::string> others = methods;
    std::erase_if(others, [](const std::string& method) { return std::find(telling_methods.begin(), telling_methods.end(), method) != telling_methods.end(); });
    return others;
}

INSTANTIATE_TEST_SUITE_P(Methods, WorkGroups, testing::ValuesIn(telling_methods), [](const auto& method) { return method.param; });
INSTANTIATE_TEST_SUITE_P(LongMethods, WorkGroups, testing::ValuesIn(other_methods()), [](const auto& method) { return method.param; });

} // namespace
