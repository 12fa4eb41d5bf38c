// What goes wrong in the middle of a render loses nothing that was finished: the checkpoint is saved, then the image, and the
// error comes last with its status. Faults are asked for by SUNDOG_FAULT (base/fault_injection.h).
#include "cli/small_scene.h"
#include "cli/sundog_process.h"
#include "film/image_io.h"

namespace sundog::cli {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

class CliFailingRender : public InFolder {
protected:
    CliFailingRender() { write("scene.xml", SmallScene{}.xml()); }

    Outcome render(const std::string& method, const std::string& iterations, std::vector<std::string> options, const std::string& fault = "") const
    {
        options.insert(options.begin(), {"render", "scene.xml", "-m", method, "-n", iterations, "-o", "a.exr"});
        return run(options, fault.empty() ? std::map<std::string, std::string>{} : std::map<std::string, std::string>{{"SUNDOG_FAULT", fault}});
    }
    std::vector<float> pixels() const { return read_image(folder / "a.exr").pixels; }
    // R, G, B, which a reader gives first. First hits of an iteration that failed may be in the image.
    std::vector<float> radiance() const
    {
        const Image image = read_image(folder / "a.exr");
        std::vector<float> values;
        for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size()) values.insert(values.end(), &image.pixels[i], &image.pixels[i] + 3);
        return values;
    }
    std::vector<float> whole(const std::string& method, const std::string& iterations) const
    {
        const Outcome outcome = render(method, iterations, {});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return pixels();
    }
    // A render that fails in its fourth iteration keeps three, and goes on from there as if nothing had been.
    void expect_nothing_lost(const std::string& method, const std::string& fault, int status, const std::string& message) const
    {
        SCOPED_TRACE(method + " " + fault);
        std::filesystem::remove(folder / "c");
        const Outcome failed = render(method, "5", {"--checkpoint", "c", "--stats", "s.json", "--progress", "bar"}, fault);
        EXPECT_EQ(failed.status, status) << failed.err;
        EXPECT_THAT(failed.err, HasSubstr("saved what 3 iterations gave before the failure\n"));
        EXPECT_THAT(failed.err, EndsWith("sundog: error: " + message + "\n"));
        EXPECT_THAT(read("s.json"), HasSubstr("\"iterations\": 3"));
        const std::vector<float> saved = radiance();
        whole(method, "3");
        EXPECT_TRUE(saved == radiance());
        const Outcome resumed = render(method, "5", {"--checkpoint", "c", "--resume"});
        EXPECT_EQ(resumed.status, 0) << resumed.err;
        EXPECT_THAT(resumed.err, HasSubstr("resumed from c after 3 iterations"));
        const std::vector<float> after = pixels();
        EXPECT_TRUE(after == whole(method, "5"));
    }
};

constexpr const char* asked_for = "this fault was asked for by SUNDOG_FAULT";
constexpr const char* no_memory = "out of host memory; use a smaller film, fewer photons or a smaller scene";

TEST_F(CliFailingRender, between_iterations_nothing_is_lost)
{
    expect_nothing_lost("path", "iterate@4:device", 4, asked_for);
    expect_nothing_lost("path", "iterate@4:memory", 1, no_memory);
    expect_nothing_lost("sppm", "iterate@4:other", 1, std::string("internal error: ") + asked_for);
}

// When first hits and totals are already those of the fourth iteration.
TEST_F(CliFailingRender, in_the_middle_of_an_iteration_nothing_is_lost)
{
    expect_nothing_lost("path", "accumulate@4:device", 4, asked_for);
    expect_nothing_lost("vcm", "accumulate@4:memory", 1, no_memory);
}

// sppm has added the iteration's photons to its pixels by then: what is saved must not hold half of an iteration.
TEST_F(CliFailingRender, half_an_iteration_is_not_saved)
{
    ASSERT_EQ(render("sppm", "2", {"--checkpoint", "c"}).status, 0);
    const std::string saved = read("c");
    const Outcome failed = render("sppm", "5", {"--checkpoint", "c", "--resume"}, "accumulate@2:device");
    EXPECT_EQ(failed.status, 4);
    EXPECT_THAT(failed.err, HasSubstr("sundog: warning: c: left as it was: the iteration that failed has changed what 3 iterations had added up to"));
    EXPECT_TRUE(read("c") == saved);
    EXPECT_TRUE(std::filesystem::exists(folder / "a.exr"));
}

TEST_F(CliFailingRender, memory_for_the_image_alone_does_not_lose_the_render)
{
    const Outcome failed = render("path", "3", {"--checkpoint", "c"}, "image@1:memory");
    EXPECT_EQ(failed.status, 1);
    EXPECT_THAT(failed.err, EndsWith(std::string("sundog: error: ") + no_memory + "\n"));
    EXPECT_EQ(render("path", "3", {"--checkpoint", "c", "--resume"}).status, 0);
    const std::vector<float> resumed = pixels();
    EXPECT_TRUE(resumed == whole("path", "3"));
}

TEST_F(CliFailingRender, checkpoints_and_previews_that_fail_do_not_end_a_render)
{
    const Outcome checkpoint = render("path", "3", {"--checkpoint", "c", "--checkpoint-every", "1e-9"}, "checkpoint@2:memory");
    EXPECT_EQ(checkpoint.status, 0) << checkpoint.err;
    EXPECT_THAT(checkpoint.err, HasSubstr(std::string("sundog: warning: no checkpoint now: ") + no_memory));
    const Outcome preview = render("path", "3", {"--preview", "localhost:9"}, "preview@1:memory");
    EXPECT_EQ(preview.status, 0) << preview.err;
    EXPECT_THAT(preview.err, HasSubstr(std::string("sundog: warning: no preview from now on: ") + no_memory));
}

// `timeout` and terminals that are closed; a reader that has gone away.
TEST_F(CliFailingRender, every_signal_saves_and_ends)
{
    for (const int signal : {SIGHUP, SIGPIPE, SIGXFSZ}) {
        std::filesystem::remove(folder / "c");
        const Interruption soon{[](const std::string& err) { return std::count(err.begin(), err.end(), '\n') >= 2; }, signal};
        const Outcome outcome = run({"render", "scene.xml", "-n", "1000000000", "--checkpoint", "c", "-o", "a.pfm", "--progress", "json"}, {}, soon);
        EXPECT_EQ(outcome.status, 130) << signal << outcome.err;
        EXPECT_TRUE(std::filesystem::exists(folder / "c"));
        EXPECT_TRUE(std::filesystem::exists(folder / "a.pfm"));
    }
}

TEST_F(CliFailingRender, a_reader_that_goes_away_ends_the_render_in_order)
{
    const std::string command = "cd '" + folder.string() + "' && ('" + test::sundog_executable().string() +
                                "' render scene.xml -n 1000000000 -o a.pfm --progress json 2>&1; echo $? > status) | head -n 2 > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(read("status"), "130\n");
    EXPECT_TRUE(std::filesystem::exists(folder / "a.pfm"));
}

} // namespace
} // namespace sundog::cli
