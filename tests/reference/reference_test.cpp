// Scenes that a user of Mitsuba 3 would write (NAME.xml), rendered by path tracing and compared with what Mitsuba made
// of them (NAME.exr, from scripts/reference). unsupported.txt lists the scenes that Sundog cannot render yet: those must
// be refused, so that a scene whose feature arrives has to leave the list and match.
#include "cli/sundog_process.h"
#include "film/image_io.h"
#include "reference/agreement.h"
#include "support/places.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <regex>

using namespace sundog;
using namespace sundog::test;

namespace
{

const std::filesystem::path folder = source_folder() / "tests/reference";

// Of all scenes together: the probability that a right renderer fails.
constexpr double level_of_all = 0.01;
constexpr int replicates = 8;
constexpr std::uint64_t iterations = 32; // in each replicate

std::string text_of(const std::filesystem::path& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::filesystem::path scene_file(const std::string& name)
{
    return folder / (name + ".xml");
}

// Name of a scene and words of the message that refuses it: "name: words", # starts a comment.
std::map<std::string, std::string> unsupported_scenes()
{
    std::map<std::string, std::string> listed;
    std::ifstream file(folder / "unsupported.txt");
    for (std::string line; std::getline(file, line);) {
        const auto colon = line.find(": ");
        if (!line.empty() && line[0] != '#') listed[line.substr(0, colon)] = colon == std::string::npos ? "" : line.substr(colon + 2);
    }
    return listed;
}

std::vector<std::string> all_scenes()
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".xml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<std::string> supported_scenes()
{
    const auto unsupported = unsupported_scenes();
    std::vector<std::string> names = all_scenes();
    std::erase_if(names, [&](const std::string& name) { return unsupported.contains(name); });
    return names;
}

std::vector<std::string> keys(const std::map<std::string, std::string>& map)
{
    std::vector<std::string> names;
    for (const auto& [name, words] : map) names.push_back(name);
    return names;
}

// A name that gtest takes.
std::string test_name(const testing::TestParamInfo<std::string>& info)
{
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

double level_of_one()
{
    return level_of_all / static_cast<double>(all_scenes().size());
}

NoisyImage reference_of(const std::string& name)
{
    return stored_reference(read_image(folder / (name + ".exr")));
}

std::vector<Image> render_replicates(const Scene& scene)
{
    std::vector<Image> images;
    for (std::uint64_t seed = 1; seed <= replicates; seed++) images.push_back(render(scene, {"path", iterations, {}}, seed));
    return images;
}

class ReferenceScene : public testing::TestWithParam<std::string>
{
};

TEST_P(ReferenceScene, MatchesMitsuba)
{
    const LoadedScene loaded = load_scene(scene_file(GetParam()), {});
    // A scene's comment announces the parameters that have no effect: "warns of NAME".
    for (const std::string& warning : loaded.warnings) {
        std::smatch name;
        ASSERT_TRUE(std::regex_search(warning, name, std::regex("parameter '(\\w+)'"))) << warning;
        EXPECT_THAT(text_of(scene_file(GetParam())), testing::HasSubstr("warns of " + name.str(1))) << warning;
    }
    const NoisyImage reference = reference_of(GetParam());
    const NoisyImage image = noisy_image(render_replicates(loaded.scene));
    ASSERT_EQ(image.width, reference.width);
    ASSERT_EQ(image.height, reference.height);
    // Two tests, half of the level each.
    EXPECT_TRUE(regions_agree(image, reference, 0.5 * level_of_one()));
    EXPECT_TRUE(relmse_agrees(image, reference, 0.5 * level_of_one()));
    const BiasRelmse relmse = bias_relmse(image, reference);
    fmt::print("relmse of the noise {:.2g}, of the bias {:.2g} +- {:.1g}; a bias of {:.2g} % in 16x16 pixels would be found\n",
               relmse.of_noise, relmse.value, relmse.standard_error, 100.0 * typical_sensitivity(image, reference, 0.5 * level_of_one()));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ReferenceScene, testing::ValuesIn(supported_scenes()), test_name);

class UnsupportedScene : public testing::TestWithParam<std::string>
{
};

// When this fails because the scene renders: take it off unsupported.txt.
TEST_P(UnsupportedScene, IsRefused)
{
    ASSERT_TRUE(std::filesystem::exists(scene_file(GetParam()))) << "unsupported.txt names a scene that is not there";
    const auto out = std::filesystem::temp_directory_path() / ("sundog-unsupported-" + GetParam() + ".pfm");
    const auto outcome = cli::run_sundog({"render", scene_file(GetParam()).string(), "-n", "1", "-q", "-o", out.string()}, folder);
    EXPECT_EQ(outcome.status, 3) << outcome.err << "Scene " << GetParam()
                                 << " is on unsupported.txt, but is not refused: take it off the list";
    EXPECT_THAT(outcome.err, testing::HasSubstr(unsupported_scenes()[GetParam()]));
    std::filesystem::remove(out);
}

INSTANTIATE_TEST_SUITE_P(Scenes, UnsupportedScene, testing::ValuesIn(keys(unsupported_scenes())), test_name);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(UnsupportedScene); // when all is supported

TEST(ReferenceScenes, EachHasAReferenceAndSaysWhatItShows)
{
    EXPECT_GE(all_scenes().size(), 25u);
    for (const std::string& name : all_scenes()) {
        EXPECT_TRUE(std::filesystem::exists(folder / (name + ".exr"))) << name << ": run scripts/reference";
        EXPECT_NE(text_of(scene_file(name)).find("<!-- "), std::string::npos) << name;
    }
}

// The comparison itself finds what it should.
class ReferenceComparison : public testing::Test
{
protected:
    static NoisyImage changed(const std::function<void(Image&)>& change)
    {
        static const std::vector<Image> images = render_replicates(load_scene(scene_file("diffuse"), {}).scene);
        std::vector<Image> copies = images;
        for (Image& image : copies) change(image);
        return noisy_image(copies);
    }
    static void scale(Image& image, const Region& region, float factor)
    {
        for (int y = region.y0; y < region.y1; y++)
            for (int x = region.x0; x < region.x1; x++)
                for (int channel = 0; channel < 3; channel++) image.at(x, y, channel) *= factor;
    }
    const NoisyImage reference = reference_of("diffuse");
};

TEST_F(ReferenceComparison, AcceptsTheRightImage)
{
    const NoisyImage image = changed([](Image&) {});
    EXPECT_TRUE(regions_agree(image, reference, level_of_one()));
    EXPECT_TRUE(relmse_agrees(image, reference, level_of_one()));
}

TEST_F(ReferenceComparison, FindsAnImageOnePercentTooBright)
{
    EXPECT_FALSE(regions_agree(changed([](Image& image) {
                                   scale(image, {0, 0, image.width, image.height}, 1.01f);
                               }),
                               reference, level_of_one()));
}

TEST_F(ReferenceComparison, FindsARegionTwoPercentTooDark)
{
    EXPECT_FALSE(regions_agree(changed([](Image& image) { scale(image, {16, 24, 32, 40}, 0.98f); }), reference, level_of_one()));
}

TEST_F(ReferenceComparison, FindsAShiftOfOnePixel)
{
    const NoisyImage image = changed([](Image& shifted) {
        const Image before = shifted;
        for (int y = 0; y < before.height; y++)
            for (int x = 1; x < before.width; x++)
                for (int channel = 0; channel < 3; channel++) shifted.at(x, y, channel) = before.at(x - 1, y, channel);
    });
    EXPECT_FALSE(relmse_agrees(image, reference, level_of_one()));
}

TEST_F(ReferenceComparison, FindsASwapOfChannels)
{
    const NoisyImage image = changed([](Image& swapped) {
        for (int y = 0; y < swapped.height; y++)
            for (int x = 0; x < swapped.width; x++) std::swap(swapped.at(x, y, 0), swapped.at(x, y, 2));
    });
    EXPECT_FALSE(regions_agree(image, reference, level_of_one()));
    EXPECT_FALSE(relmse_agrees(image, reference, level_of_one()));
}

// Known two-sided quantiles of Student's t distribution (1 and 10 degrees of freedom, in closed form and tabulated).
TEST(ReferenceStatistics, StudentsDistribution)
{
    EXPECT_NEAR(student_two_sided_p(1.0, 1.0), 0.5, 1e-6); // Cauchy: 1 - 2 atan(t) / pi
    EXPECT_NEAR(student_two_sided_p(100.0, 1.0) / (1.0 - 2.0 * std::atan(100.0) / std::numbers::pi), 1.0, 1e-6);
    EXPECT_NEAR(student_two_sided_quantile(10.0, 0.05), 2.228139, 1e-5);
    EXPECT_NEAR(student_two_sided_quantile(10.0, 0.001), 4.586894, 1e-5);
}

} // namespace
