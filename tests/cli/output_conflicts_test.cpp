// What an output must not overwrite is found before anything is read.
#include "cli/small_scene.h"
#include "cli/sundog_process.h"

#include <sys/stat.h>

namespace sundog::cli {
namespace {

class CliOutputConflicts : public InFolder {
protected:
    CliOutputConflicts() { write("scene.xml", "no scene: it is not read"); }

    void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) const
    {
        const std::string before = read("scene.xml");
        expect_failure(run(arguments), 2, parts);
        EXPECT_EQ(read("scene.xml"), before);
    }
};

TEST_F(CliOutputConflicts, outputs_on_the_scene)
{
    std::filesystem::create_symlink("scene.xml", folder / "link.exr");
    std::filesystem::create_hard_link(folder / "scene.xml", folder / "hard");
    expect_refused({"render", "scene.xml", "--stats", "scene.xml"}, {"--stats scene.xml would overwrite the scene; choose another name"});
    expect_refused({"render", "scene.xml", "--stats", "./hard"}, {"--stats ./hard would overwrite the scene"});
    expect_refused({"render", "scene.xml", "-o", "link.exr"}, {"-o link.exr would overwrite the scene"});
    expect_refused({"render", "scene.xml", "--error-image", "link.exr"}, {"--error-image link.exr would overwrite the scene"});
    expect_refused({"render", "scene.xml", "--checkpoint", (folder / "scene.xml").string()}, {"would overwrite the scene"});
    expect_refused({"render", "scene.xml", "-p", "save_map=scene.xml"}, {"save_map scene.xml would overwrite the scene"});
    expect_refused({"info", "scene.xml", "--dump", "hard"}, {"--dump hard would overwrite the scene itself"});
}

TEST_F(CliOutputConflicts, outputs_on_what_the_scene_reads)
{
    write("texture.pfm", std::string("PF\n1 1\n-1\n") + std::string(12, '\0'));
    write("part.xml", "<scene version=\"3.0.0\"><bsdf type=\"diffuse\" id=\"b\"><texture type=\"bitmap\" name=\"reflectance\">"
                      "<string name=\"filename\" value=\"texture.pfm\"/></texture></bsdf></scene>");
    write("scene.xml", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><emitter type=\"constant\"/><include filename=\"part.xml\"/>"
                       "<shape type=\"rectangle\"><ref id=\"b\"/></shape></scene>");
    expect_refused({"render", "scene.xml", "-o", "texture.pfm"}, {"-o texture.pfm would overwrite a file that the scene reads; choose another name"});
    expect_refused({"render", "scene.xml", "--stats", "part.xml"}, {"--stats part.xml would overwrite a file that the scene reads"});
}

TEST_F(CliOutputConflicts, outputs_that_are_each_other)
{
    std::filesystem::create_symlink("a.exr", folder / "link");
    const auto expect_one_file = [&](std::vector<std::string> options, const std::string& message) {
        options.insert(options.begin(), {"render", "scene.xml"});
        expect_refused(options, {message, "are one file; choose another name for one of them"});
    };
    expect_one_file({"-o", "a.exr", "-o", "./a.exr"}, "-o a.exr and -o ./a.exr");
    expect_one_file({"-o", "a.exr", "--stats", "link"}, "-o a.exr and --stats link");
    expect_one_file({"-o", "a.exr", "--checkpoint", "a.exr"}, "-o a.exr and --checkpoint a.exr");
    expect_one_file({"-o", "a.exr", "--error-image", "a.exr"}, "-o a.exr and --error-image a.exr");
    expect_one_file({"--stats", "s", "--checkpoint", "s"}, "--stats s and --checkpoint s");
    expect_one_file({"--checkpoint", "scene.exr"}, "-o scene.exr and --checkpoint scene.exr");
    expect_refused({"render", "scene.xml", "-p", "load_map=m", "--checkpoint", "m"}, {"--checkpoint m would overwrite the photon maps"});
}

TEST_F(CliOutputConflicts, devices_pipes_and_standard_output_stay_what_they_are)
{
    write("scene.xml", SmallScene{}.xml());
    std::filesystem::create_symlink("/dev/stdout", folder / "out");
    const Outcome outcome = run({"render", "scene.xml", "-n", "1", "-o", "a.pfm", "-q", "--stats", "out"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, ::testing::HasSubstr("\"iterations\": 1"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "out"));
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    expect_failure(run({"render", "scene.xml", "-o", "a.pfm", "--checkpoint", "pipe"}), 5, {"pipe: cannot be replaced, it is a device or a pipe"});
    EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
}

TEST_F(CliOutputConflicts, two_renders_with_one_checkpoint)
{
    write("scene.xml", SmallScene{}.xml());
    bool tried = false;
    const Interruption second{[&](const std::string& err) {
        if (tried || std::count(err.begin(), err.end(), '\n') < 2) return tried;
        expect_failure(run({"render", "scene.xml", "-n", "1", "-o", "b.pfm", "--checkpoint", "c", "--resume"}), 5,
                       {"c: another sundog is using it; wait until that has ended, or give another file"});
        tried = true;
        return true;
    }};
    EXPECT_EQ(run({"render", "scene.xml", "-n", "1000000000", "-o", "a.pfm", "--progress", "json", "--checkpoint", "c"}, {}, second).status, 130);
    EXPECT_TRUE(tried);
    EXPECT_EQ(run({"render", "scene.xml", "-n", "1", "-o", "b.pfm", "--checkpoint", "c", "--resume", "-q"}).status, 0);
    EXPECT_THAT(files(), ::testing::ElementsAre("a.pfm", "b.pfm", "c", "scene.xml")) << "no lock or temporary file is left";
}

} // namespace
} // namespace sundog::cli
