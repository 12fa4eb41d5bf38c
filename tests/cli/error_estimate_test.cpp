// `sundog render --errors --error-image --target-error`, as a user would.
#include "cli/small_scene.h"
#include "cli/sundog_process.h"
#include "film/error_estimate.h"
#include "film/image_io.h"

#include <nlohmann/json.hpp>

namespace sundog::cli
{
namespace
{

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::Pair;

class CliErrors : public InFolder
{
protected:
    CliErrors() { write("scene.xml", SmallScene{}.xml()); }

    Outcome render(std::vector<std::string> options) const
    {
        options.insert(options.begin(), {"render", "scene.xml", "-p", "sampler=independent"});
        const Outcome outcome = run(options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome;
    }
    nlohmann::json stats() const { return nlohmann::json::parse(read("s.json")); }
};

TEST_F(CliErrors, a_render_stops_at_its_target_and_says_what_it_reached)
{
    for (const char* method : {"path", "sppm"}) {
        SCOPED_TRACE(method);
        const Outcome outcome = render({"-m", method, "--target-error", "0.01", "-o", "a.pfm", "--stats", "s.json", "--progress", "json"});
        const auto error = stats()["error"];
        EXPECT_EQ(error["confidence"], 0.9);
        EXPECT_EQ(error["target"], 0.01);
        EXPECT_EQ(error["target_met"], true);
        EXPECT_LE(error["bound"], 0.01);
        EXPECT_GT(error["bound"], 0.005);
        EXPECT_GE(stats()["iterations"], 8);
        EXPECT_THAT(outcome.err, HasSubstr("\"target_error\":0.01"));
        // A looser target is met earlier.
        const auto iterations = stats()["iterations"].get<int>();
        render({"-m", method, "--target-error", "0.02", "-o", "a.pfm", "--stats", "s.json"});
        EXPECT_LT(stats()["iterations"].get<int>(), iterations);
    }
}

TEST_F(CliErrors, other_goals_may_come_first)
{
    const Outcome outcome = render({"--target-error", "1e-6", "-n", "3", "-o", "a.pfm", "--stats", "s.json"});
    EXPECT_THAT(outcome.err,
                HasSubstr("warning: stopped before --target-error 1e-06 was reached; give it more iterations (-n) or time (-t)"));
    EXPECT_THAT(outcome.err, HasSubstr("sundog: relative error at most "));
    EXPECT_EQ(stats()["iterations"], 3);
    EXPECT_EQ(stats()["error"]["target_met"], false);
}

TEST_F(CliErrors, a_resumed_render_stops_where_the_uninterrupted_one_does)
{
    const auto iterations = [&] { return stats()["iterations"].get<int>(); };
    render({"-m", "sppm", "--target-error", "0.01", "-o", "a.pfm", "--stats", "s.json"});
    const int whole = iterations();
    ASSERT_GT(whole, 40);
    // Also where no question comes after as many iterations.
    for (const int part : {33, whole - 1, whole}) {
        std::filesystem::remove(folder / "c");
        render({"-m", "sppm", "--errors", "-n", std::to_string(part), "--checkpoint", "c", "-o", "b.pfm"});
        render({"-m", "sppm", "--target-error", "0.01", "--checkpoint", "c", "--resume", "-o", "b.pfm", "--stats", "s.json"});
        EXPECT_EQ(iterations(), whole) << part;
        EXPECT_TRUE(read("a.pfm") == read("b.pfm")) << part;
    }
}

TEST_F(CliErrors, without_being_asked_nothing_is_estimated)
{
    const Outcome outcome = render({"-n", "2", "-o", "a.pfm", "--stats", "s.json", "-v"});
    EXPECT_FALSE(stats().contains("error"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("relative error")));
    EXPECT_THAT(outcome.err, Not(HasSubstr("Sum error bounds")));
}

#ifndef SUNDOG_MINIMAL

TEST_F(CliErrors, channels_and_metadata_say_how_sure_they_are)
{
    render({"-m", "sppm", "--errors", "--error-confidence", "0.5", "-n", "9", "-o", "half.exr"});
    render({"-m", "sppm", "--errors", "-n", "9", "-o", "most.exr"});
    const Image half = read_image(folder / "half.exr"), most = read_image(folder / "most.exr");
    EXPECT_THAT(most.channels, IsSupersetOf({"R", "variance.R", "error.R", "error.G", "error.B", "bias.R", "bias.G", "bias.B"}));
    EXPECT_THAT(half.metadata, Contains(Pair("sundog:error_confidence", "0.5")));
    EXPECT_THAT(most.metadata, Contains(Pair("sundog:error_confidence", "0.9")));
    EXPECT_THAT(most.metadata, Contains(Pair("sundog:error_bound", ::testing::_)));
    EXPECT_LT(relative_bound(half), 0.6 * relative_bound(most)); // quantiles of 8 degrees of freedom: 0.706 and 1.860
    render({"-m", "path", "--errors", "-n", "9", "-o", "path.exr"});
    EXPECT_THAT(read_image(folder / "path.exr").channels, Not(Contains("bias.R")));
}

TEST_F(CliErrors, a_heat_map_is_an_image_of_its_own)
{
    const Outcome outcome = render({"-n", "4", "-o", "a.exr", "--error-image", "e.png"});
    EXPECT_THAT(outcome.err, HasSubstr("e.png: relative error bound from 0.001 (dark blue)"));
    EXPECT_EQ(read_image(folder / "e.png").width, 16);
    EXPECT_THAT(read_image(folder / "a.exr").channels, Contains("error.R"));
    expect_failure(run({"render", "scene.xml", "--error-image", "e.xyz"}), 5, {"e.xyz: ", "unknown ending .xyz"});
}

// The bound of two renders together is smaller by sqrt(2), and a bit more since they know the deviations better.
TEST_F(CliErrors, merged_bounds_are_smaller)
{
    for (const char* seed : {"1", "2"}) render({"--errors", "-n", "40", "-s", seed, "-o", std::string(seed) + ".exr"});
    EXPECT_EQ(run({"merge", "sum.exr", "1.exr", "2.exr"}).status, 0);
    const Image sum = read_image(folder / "sum.exr");
    EXPECT_NEAR(relative_bound(sum) / relative_bound(read_image(folder / "1.exr")), std::sqrt(0.5), 0.05);
    render({"--errors", "--error-confidence", "0.8", "-n", "40", "-s", "3", "-o", "3.exr"});
    expect_failure(run({"merge", "sum.exr", "1.exr", "3.exr"}), 5,
                   {"3.exr: cannot be merged, its error confidence is 0.8 but that of 1.exr is 0.9"});
}

TEST_F(CliErrors, one_photon_map_cannot_tell_its_error_and_fresh_ones_can)
{
    const auto errors_of = [&](const std::vector<std::string>& parameters, const char* option = "--errors") {
        std::vector<std::string> arguments{"render", "scene.xml", "-m", "photonmapper", "-n", "2", "-o", "p.exr", option};
        if (arguments.back() == "--target-error") arguments.push_back("0.5");
        for (const std::string& parameter : parameters) arguments.insert(arguments.end(), {"-p", parameter});
        return run(arguments);
    };
    for (const char* option : {"--errors", "--target-error"})
        expect_failure(errors_of({}, option), 2,
                       {"photonmapper estimates its error with maps=fresh, not with maps=one: use -p maps=fresh"});
    expect_failure(errors_of({"maps=fresh", "precompute=true", "max_depth=-1"}), 2, {"no bias of irradiance", "use -p precompute=false"});
    expect_failure(errors_of({"maps=fresh", "relaxation=5"}), 2, {"no bias of photons that were moved", "use -p relaxation=0"});
    EXPECT_EQ(files(), std::vector<std::string>{"scene.xml"}) << "found before rendering";
    // Its radii stay, and so does their bias: a target may be out of reach.
    const std::vector<std::string> fresh{"render",     "scene.xml",      "-m", "photonmapper", "-p",
                                         "maps=fresh", "--target-error", "5",  "-o",           "p.exr"};
    expect_failure(run(fresh), 2, {"photonmapper keeps a bias however long it renders", "give -n or -t as well"});
    std::vector<std::string> bounded = fresh;
    bounded.insert(bounded.end(), {"-n", "20", "--stats", "s.json"});
    EXPECT_EQ(run(bounded).status, 0);
    EXPECT_EQ(stats()["error"]["target_met"], true);
    EXPECT_EQ(stats()["iterations"], 8);
    for (const char* lookup : {"lookup=radius", "lookup=nearest"}) {
        const Outcome outcome = errors_of({"maps=fresh", lookup});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_THAT(read_image(folder / "p.exr").channels, IsSupersetOf({"error.R", "bias.R"}));
    }
}

#endif

} // namespace
} // namespace sundog::cli
