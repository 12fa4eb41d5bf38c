// `sundog merge` of renders made apart.
#include "cli/small_scene.h"
#include "cli/sundog_process.h"
#include "film/image_io.h"

namespace sundog::cli {
namespace {

using ::testing::Contains;
using ::testing::Pair;

class CliMerge : public InFolder {
protected:
    CliMerge() { write("scene.xml", SmallScene{}.xml()); }

    void render(const std::string& file, const std::string& seed, const std::string& iterations, const std::string& method = "path",
                const std::string& size = "16x12") const
    {
        const Outcome outcome = run({"render", "scene.xml", "-m", method, "-s", seed, "-n", iterations, "--size", size, "-o", file, "-q"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
    }
};

TEST_F(CliMerge, out_is_checked_first)
{
    expect_failure(run({"merge", "a.xyz", "none.exr"}), 5, {"a.xyz: ", "unknown ending .xyz"});
    expect_failure(run({"merge", "missing/a.pfm", "none.exr"}), 5, {"missing/a.pfm: ", "there is no folder missing"});
}

#ifdef SUNDOG_MINIMAL

TEST_F(CliMerge, a_minimal_build_says_what_it_lacks)
{
    expect_failure(run({"merge", "m.pfm", "a.pfm"}), 5, {"merge needs .exr parts", "this build of Sundog knows .pfm only"});
}

#else

TEST_F(CliMerge, parts_count_by_their_iterations)
{
    for (const char* method : {"path", "ptracer", "pppm", "sppm"}) {
        SCOPED_TRACE(method);
        render("a.exr", "1", "2", method);
        render("b.exr", "2", "6", method);
        const Outcome outcome = run({"merge", "m.exr", "a.exr", "b.exr"});
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(outcome.err, "sundog: merged 2 parts into m.exr (8 iterations, seeds 1 2)\n");
        const Image a = read_image(folder / "a.exr"), b = read_image(folder / "b.exr"), merged = read_image(folder / "m.exr");
        ASSERT_EQ(merged.channels, a.channels);
        double mean_square = 0.0;
        for (std::size_t i = 0; i < merged.pixels.size(); i++) {
            if (a.channels[i % a.channels.size()].starts_with("variance.")) {
                mean_square += merged.pixels[i];
                continue;
            }
            const float mean = static_cast<float>(0.25 * a.pixels[i] + 0.75 * b.pixels[i]);
            ASSERT_NEAR(merged.pixels[i], mean, 1e-6f * std::abs(mean)) << a.channels[i % a.channels.size()];
        }
        EXPECT_GT(mean_square, 0.0);
        EXPECT_THAT(merged.metadata, Contains(Pair("sundog:seed", "1 2")));
        EXPECT_THAT(merged.metadata, Contains(Pair("sundog:iterations", "8")));
        EXPECT_THAT(merged.metadata, Contains(Pair("sundog:camera_subpaths", std::to_string(8 * 16 * 12))));
        EXPECT_THAT(merged.metadata, Contains(Pair("sundog:method", method)));
    }
}

// Merging in any grouping is the same, and OUT may be a part: a sum that grows as renders come in.
TEST_F(CliMerge, merged_images_can_be_merged)
{
    render("a.exr", "1", "2");
    render("b.exr", "2", "3");
    render("c.exr", "3", "4");
    EXPECT_EQ(run({"merge", "all.exr", "a.exr", "b.exr", "c.exr"}).status, 0);
    EXPECT_EQ(run({"merge", "sum.exr", "a.exr"}).status, 0);
    EXPECT_EQ(run({"merge", "sum.exr", "sum.exr", "b.exr"}).status, 0);
    EXPECT_EQ(run({"merge", "sum.exr", "sum.exr", "c.exr"}).status, 0);
    const Image all = read_image(folder / "all.exr"), sum = read_image(folder / "sum.exr");
    EXPECT_THAT(sum.metadata, Contains(Pair("sundog:seed", "1 2 3")));
    // Variances come of differences of means that were rounded to floats at each step.
    for (std::size_t i = 0; i < all.pixels.size(); i++) ASSERT_NEAR(sum.pixels[i], all.pixels[i], 1e-5f * (std::abs(all.pixels[i]) + 1e-3f)) << i;
    expect_failure(run({"merge", "sum.exr", "sum.exr", "b.exr"}), 5, {"b.exr: cannot be merged, it was rendered with seed 2, as sum.exr was"});
}

TEST_F(CliMerge, parts_that_do_not_belong_together_are_refused)
{
    render("a.exr", "1", "1");
    render("again.exr", "1", "2");
    render("other.exr", "2", "1", "ptracer");
    render("small.exr", "2", "1", "path", "8x6");
    render("plain.pfm", "2", "1");
    SmallScene brighter;
    brighter.emitter.replace(brighter.emitter.find("10, 10, 10"), 10, "10, 10, 11");
    write("scene.xml", brighter.xml());
    render("brighter.exr", "2", "1");
    const auto expect_refused = [&](const char* part, const std::vector<std::string>& why) { expect_failure(run({"merge", "m.exr", "a.exr", part}), 5, why); };
    expect_refused("again.exr", {"again.exr: cannot be merged, it was rendered with seed 1, as a.exr was: the same random numbers"});
    expect_refused("other.exr", {"other.exr: cannot be merged, its method is ptracer but that of a.exr is path"});
    expect_refused("small.exr", {"small.exr: cannot be merged, its size is 8x6 but that of a.exr is 16x12"});
    expect_refused("brighter.exr", {"brighter.exr: cannot be merged, it shows another scene"});
    expect_refused("plain.pfm", {"plain.pfm: cannot be merged, it has no metadata sundog:iterations; parts are .exr files"});
    expect_refused("none.exr", {"none.exr: cannot read, there is no such file"});
    EXPECT_FALSE(std::filesystem::exists(folder / "m.exr"));
}

#endif

} // namespace
} // namespace sundog::cli
