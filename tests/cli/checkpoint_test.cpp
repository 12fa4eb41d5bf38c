// `sundog render --checkpoint --resume`: in processes of their own, as a user would.
#include "cli/small_scene.h"
#include "cli/sundog_process.h"

#include <nlohmann/json.hpp>

namespace sundog::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliCheckpoint : public InFolder {
protected:
    CliCheckpoint() { write("scene.xml", SmallScene{}.xml()); }

    Outcome render(std::vector<std::string> options, Interruption interruption = {}) const
    {
        options.insert(options.begin(), {"render", "scene.xml"});
        return run(options, {}, std::move(interruption));
    }
    void expect_done(const Outcome& outcome) const { EXPECT_EQ(outcome.status, 0) << outcome.err; }

    // The image, as PFM, of so many iterations in one go.
    std::string whole(const std::string& iterations, std::vector<std::string> options = {}) const
    {
        options.insert(options.end(), {"-n", iterations, "-o", "whole.pfm"});
        expect_done(render(options));
        return read("whole.pfm");
    }
    nlohmann::json stats() const { return nlohmann::json::parse(read("s.json")); }
    std::uint64_t saved_iterations() const
    {
        const std::string text = read("c");
        const auto start = text.find("render{") + std::string("render").size(); // a section's name, then its JSON, which holds no other object
        return nlohmann::json::parse(text.substr(start, text.find('}', start) + 1 - start))["iterations"].get<std::uint64_t>();
    }
};

TEST_F(CliCheckpoint, resumed_is_uninterrupted)
{
    for (const char* method : {"path", "ptracer", "pppm", "sppm"}) {
        SCOPED_TRACE(method);
        std::filesystem::remove(folder / "c");
        for (const char* end : {"1", "3", "4"})
            expect_done(render({"-m", method, "-n", end, "--checkpoint", "c", "--resume", "-o", "a.pfm", "--stats", "s.json"}));
        EXPECT_TRUE(read("a.pfm") == whole("4", {"-m", method}));
        EXPECT_EQ(stats()["iterations"], 4);
        EXPECT_EQ(stats()["resumed_iterations"], 3);
        EXPECT_EQ(stats()["camera_subpaths"], 4 * 16 * 12);
    }
}

TEST_F(CliCheckpoint, an_interrupted_render_saves_one)
{
    for (int signal : {SIGINT, SIGTERM}) {
        const Interruption soon{[](const std::string& err) { return std::count(err.begin(), err.end(), '\n') >= 3; }, signal};
        const Outcome outcome =
            render({"-n", "1000000000", "-m", "sppm", "--checkpoint", "c", "-o", "a.pfm", "--stats", "s.json", "--progress", "json"}, soon);
        EXPECT_EQ(outcome.status, 130) << outcome.err;
        const std::uint64_t done = stats()["iterations"];
        EXPECT_EQ(saved_iterations(), done);
        const std::string more = std::to_string(done + 3);
        expect_done(render({"-n", more, "-m", "sppm", "--checkpoint", "c", "--resume", "-o", "a.pfm"}));
        EXPECT_TRUE(read("a.pfm") == whole(more, {"-m", "sppm"}));
        std::filesystem::remove(folder / "c");
    }
}

// Nothing at all may run at the end: what counts is what was saved before.
TEST_F(CliCheckpoint, a_killed_render_leaves_the_last_one)
{
    const Interruption once_saved{[this](const std::string&) { return std::filesystem::exists(folder / "c"); }, SIGKILL};
    const Outcome outcome = render(
        {"-n", "1000000000", "-m", "pppm", "--checkpoint", "c", "--checkpoint-every", "0.05", "-o", "a.pfm", "--progress", "json"}, once_saved);
    EXPECT_EQ(outcome.status, 128 + SIGKILL);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.pfm"));
    const std::string more = std::to_string(saved_iterations() + 2);
    expect_done(render({"-n", more, "-m", "pppm", "--checkpoint", "c", "--resume", "-o", "a.pfm"}));
    EXPECT_TRUE(read("a.pfm") == whole(more, {"-m", "pppm"}));
}

// The folder goes away while the render runs: the image must not be lost for that.
TEST_F(CliCheckpoint, one_that_cannot_be_saved_does_not_stop_the_render)
{
    std::filesystem::create_directory(folder / "sub");
    bool moved = false;
    const Interruption never{[&](const std::string&) {
        if (!moved && std::filesystem::exists(folder / "sub" / "c")) {
            std::filesystem::rename(folder / "sub", folder / "elsewhere");
            moved = true;
        }
        return false;
    }};
    const Outcome outcome = render({"-t", "2", "--checkpoint", "sub/c", "--checkpoint-every", "0.2", "-o", "a.pfm", "--progress", "json"}, never);
    EXPECT_TRUE(moved);
    EXPECT_EQ(outcome.status, 5);
    EXPECT_THAT(outcome.err, HasSubstr("sundog: warning: no checkpoint now: sub/c: "));
    EXPECT_THAT(outcome.err, HasSubstr("sundog: error: sub/c: cannot write, there is no folder sub"));
    EXPECT_THAT(files(), ::testing::ElementsAre("a.pfm", "elsewhere", "scene.xml"));
}

TEST_F(CliCheckpoint, without_a_file_the_render_starts_afresh)
{
    const Outcome outcome = render({"-n", "2", "--checkpoint", "c", "--resume", "-o", "a.pfm"});
    expect_done(outcome);
    EXPECT_THAT(outcome.err, HasSubstr("sundog: there is no c yet; starting afresh\n"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("warning")));
    EXPECT_TRUE(read("a.pfm") == whole("2"));
}

TEST_F(CliCheckpoint, a_finished_render_only_writes_its_image_again)
{
    expect_done(render({"-n", "3", "--checkpoint", "c", "-o", "a.pfm"}));
    const std::string image = read("a.pfm");
    std::filesystem::remove(folder / "a.pfm");
    const Outcome same = render({"-n", "3", "--checkpoint", "c", "--resume", "-o", "a.pfm", "--stats", "s.json"});
    expect_done(same);
    EXPECT_THAT(same.err, HasSubstr("sundog: resumed from c after 3 iterations\n"));
    EXPECT_TRUE(read("a.pfm") == image);
    EXPECT_EQ(stats()["iterations"], 3);
    const Outcome fewer = render({"-n", "2", "--checkpoint", "c", "--resume", "-o", "a.pfm"});
    expect_done(fewer);
    EXPECT_THAT(fewer.err, HasSubstr("warning: c already holds 3 iterations, more than the 2 asked for"));
    EXPECT_TRUE(read("a.pfm") == image);
}

TEST_F(CliCheckpoint, seconds_are_those_of_this_run)
{
    expect_done(render({"-t", "0.5", "--checkpoint", "c", "-o", "a.pfm", "--stats", "s.json"}));
    const auto first = stats();
    expect_done(render({"-t", "0.5", "--checkpoint", "c", "--resume", "-o", "a.pfm", "--stats", "s.json"}));
    const auto second = stats();
    EXPECT_EQ(second["resumed_iterations"], first["iterations"]);
    EXPECT_GT(second["iterations"], first["iterations"]);
    EXPECT_GT(second["render_seconds"], first["render_seconds"]);
    EXPECT_GE(second["seconds"]["Trace rays"], first["seconds"]["Trace rays"]);
}

TEST_F(CliCheckpoint, an_old_one_is_replaced_with_a_warning)
{
    write("c", "something else");
    const Outcome outcome = render({"-n", "1", "--checkpoint", "c", "-o", "a.pfm", "-q"});
    expect_done(outcome);
    EXPECT_EQ(outcome.err, "sundog: warning: c will be replaced: without --resume the render starts afresh\n");
    EXPECT_EQ(saved_iterations(), 1u);
}

TEST_F(CliCheckpoint, one_of_another_render_is_refused)
{
    expect_done(render({"-n", "1", "--checkpoint", "c", "-o", "a.pfm"}));
    std::filesystem::remove(folder / "a.pfm");
    const std::string saved = read("c");
    const auto resume = [&](std::vector<std::string> options) {
        options.insert(options.end(), {"-n", "2", "--checkpoint", "c", "--resume", "-o", "a.pfm"});
        return render(options);
    };
    expect_failure(resume({"-s", "9"}), 5, {"c: cannot resume, the checkpoint is of seed 0, not 9; use -s 0"});
    expect_failure(resume({"-m", "sppm"}), 5, {"c: cannot resume, the checkpoint is of method path, not sppm; use -m path"});
    expect_failure(resume({"-p", "max_depth=5"}), 5, {"c: cannot resume, the checkpoint is of max_depth=4, not max_depth=5; use -p max_depth=4"});
    expect_failure(resume({"--size", "20x15"}), 5, {"c: cannot resume, the checkpoint is of 16x12 pixels, not 20x15"});
    SmallScene brighter;
    brighter.emitter.replace(brighter.emitter.find("10, 10, 10"), 10, "10, 10, 11");
    write("scene.xml", brighter.xml());
    expect_failure(resume({}), 5, {"c: cannot resume, the checkpoint is of another scene"});
    EXPECT_TRUE(read("c") == saved);
    EXPECT_THAT(files(), ::testing::ElementsAre("c", "scene.xml"));
}

TEST_F(CliCheckpoint, a_damaged_one_is_refused)
{
    expect_done(render({"-n", "1", "--checkpoint", "c", "-o", "a.pfm"}));
    const std::string saved = read("c");
    std::filesystem::remove(folder / "a.pfm");
    const auto expect_refused = [&](const std::string& bytes, const std::string& why) {
        write("c", bytes);
        expect_failure(render({"-n", "2", "--checkpoint", "c", "--resume", "-o", "a.pfm"}), 5, {"c: cannot resume, the file ", why, "render afresh without --resume"});
    };
    expect_refused("", "is too short for a checkpoint");
    expect_refused("once upon a time", "is not a checkpoint of sundog");
    expect_refused(saved.substr(0, saved.size() / 2), "was cut off");
    std::string changed = saved;
    changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] ^ 1);
    expect_refused(changed, "the checksum of");
    std::string later = saved;
    later[8] = 3;
    expect_refused(later, "has layout 3, this sundog reads layout 2");
    EXPECT_THAT(files(), ::testing::ElementsAre("c", "scene.xml"));
}

TEST_F(CliCheckpoint, a_place_that_cannot_be_written_is_found_before_anything_is_loaded)
{
    write("scene.xml", "broken"); // would be status 3
    expect_failure(render({"-o", "a.pfm", "--checkpoint", "missing/c"}), 5, {"missing/c: ", "there is no folder missing"});
    std::filesystem::create_directory(folder / "c");
    expect_failure(render({"-o", "a.pfm", "--checkpoint", "c", "--resume"}), 5, {"c: ", "it is a folder"});
}

} // namespace
} // namespace sundog::cli
