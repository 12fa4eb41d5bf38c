// `sundog render` and the commands that inform, run for real on the machine's device.
#include "cli/small_scene.h"
#include "cli/sundog_process.h"
#include "film/compare.h"
#include "film/image_io.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <sstream>

namespace sundog::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CliRender : public InFolder {
protected:
    CliRender() { write("scene.xml", SmallScene{}.xml()); }

    void expect_done(const Outcome& outcome) const { EXPECT_EQ(outcome.status, 0) << outcome.err; }
};

std::vector<nlohmann::json> json_lines(const std::string& text)
{
    std::vector<nlohmann::json> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("{")) lines.push_back(nlohmann::json::parse(line));
    return lines;
}

std::size_t most_iterations(const std::string& err)
{
    std::size_t most = 0;
    // The last line may not be whole yet.
    for (const auto& line : json_lines(err.substr(0, err.rfind('\n') + 1))) most = std::max(most, line["iterations"].get<std::size_t>());
    return most;
}

TEST_F(CliRender, writes_the_scene_s_name_by_default_and_says_so)
{
    const Outcome outcome = run({"render", "scene.xml"});
    expect_done(outcome);
    EXPECT_THAT(outcome.err, HasSubstr("sundog: wrote scene.exr (path, 2 iterations, "));
    EXPECT_THAT(files(), ElementsAre("scene.exr", "scene.xml"));
    const Image image = read_image(folder / "scene.exr");
    EXPECT_EQ(image.width, 16);
    EXPECT_EQ(image.height, 12);
    EXPECT_THAT(image.metadata, ::testing::Contains(::testing::Pair("sundog:method", "path")));
    EXPECT_THAT(image.channels, ::testing::IsSupersetOf({"R", "G", "B", "variance.R", "albedo.R", "N.X", "depth.Z"}));
}

TEST_F(CliRender, writes_every_output)
{
    const Outcome outcome = run({"render", "-o", "a.exr", "-o", "b.png", "-o", "c.hdr", "-o", "d.pfm", "scene.xml", "--exposure", "-1", "-n", "1", "--size", "20x10", "-q"});
    expect_done(outcome);
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(files(), ElementsAre("a.exr", "b.png", "c.hdr", "d.pfm", "scene.xml"));
    for (const char* name : {"a.exr", "b.png", "c.hdr", "d.pfm"}) EXPECT_EQ(read_image(folder / name).width, 20) << name;
    EXPECT_EQ(compare_images(read_image(folder / "a.exr"), read_image(folder / "d.pfm")).mse, 0.0);
}

TEST_F(CliRender, the_same_seed_gives_the_same_pixels)
{
    for (const char* method : {"path", "ptracer", "pppm", "sppm"}) {
        const auto render = [&](const std::string& seed, const std::string& file) {
            expect_done(run({"render", "scene.xml", "-m", method, "-n", "3", "-s", seed, "-o", file}));
            return read_image(folder / file).pixels;
        };
        const auto first = render("5", "a.exr");
        EXPECT_TRUE(first == render("5", "b.exr")) << method;
        EXPECT_FALSE(first == render("6", "c.exr")) << method;
    }
}

TEST_F(CliRender, statistics_hold_what_the_contract_names)
{
    expect_done(run({"render", "scene.xml", "-m", "sppm", "-n", "2", "-s", "18446744073709551615", "-p", "photons=1000", "-p", "direct=photons", "-o", "a.pfm",
                     "--stats", "s.json"}));
    const auto stats = nlohmann::json::parse(read("s.json"));
    EXPECT_EQ(stats["method"], "sppm");
    EXPECT_EQ(stats["parameters"]["photons"], 1000);
    EXPECT_TRUE(stats["parameters"]["alpha"].is_number());
    EXPECT_EQ(stats["parameters"]["direct"], "photons");
    EXPECT_EQ(stats["seed"], 18446744073709551615u);
    EXPECT_FALSE(stats["device"].get<std::string>().empty());
    EXPECT_EQ(stats["iterations"], 2);
    EXPECT_EQ(stats["light_subpaths"], 2000);
    EXPECT_EQ(stats["camera_subpaths"], 2 * 16 * 12);
    EXPECT_GT(stats["photons_stored"], 0);
    EXPECT_GT(stats["rays"], 2000);
    EXPECT_TRUE(stats["seconds"].is_object());
    EXPECT_FALSE(stats["seconds"].empty());
    EXPECT_GE(stats["kernel_build_seconds"], 0.0);
    EXPECT_GT(stats["peak_device_bytes"], 1000);
    EXPECT_EQ(stats["invalid_samples"], 0);
    EXPECT_GE(stats["wall_seconds"], stats["render_seconds"]);
}

TEST_F(CliRender, command_line_parameters_override_the_scene_s)
{
    SmallScene scene;
    scene.integrator = R"(<integrator type="sppm"><integer name="photons" value="50"/><float name="alpha" value="0.5"/></integrator>)";
    write("scene.xml", scene.xml());
    expect_done(run({"render", "scene.xml", "-n", "1", "-p", "photons=70", "-o", "a.pfm", "--stats", "s.json"}));
    const auto stats = nlohmann::json::parse(read("s.json"));
    EXPECT_EQ(stats["method"], "sppm");
    EXPECT_EQ(stats["parameters"]["photons"], 70);
    EXPECT_EQ(stats["parameters"]["alpha"], 0.5);
    EXPECT_EQ(stats["light_subpaths"], 70);
}

TEST_F(CliRender, scene_parameters_are_set_from_the_command_line)
{
    SmallScene scene;
    scene.film = R"(<film type="hdrfilm"><integer name="width" value="$w"/><integer name="height" value="$h"/></film>)";
    scene.extra = R"(<default name="h" value="7"/>)";
    std::string xml = scene.xml();
    const std::string first_line = "<scene version=\"3.0.0\">\n";
    xml = first_line + scene.extra + xml.substr(first_line.size()); // defaults come before their use
    write("scene.xml", xml);
    expect_done(run({"render", "scene.xml", "-n", "1", "-D", "w=9", "-o", "a.pfm"}));
    EXPECT_EQ(read_image(folder / "a.pfm").width, 9);
    EXPECT_EQ(read_image(folder / "a.pfm").height, 7);
    expect_done(run({"render", "scene.xml", "-n", "1", "-Dw=9", "-Dh=5", "-o", "a.pfm"}));
    EXPECT_EQ(read_image(folder / "a.pfm").height, 5);
}

TEST_F(CliRender, a_time_limit_ends_the_render)
{
    const Outcome outcome = run({"render", "scene.xml", "-t", "1.5", "-o", "a.pfm", "--stats", "s.json", "--progress", "json"});
    expect_done(outcome);
    const auto stats = nlohmann::json::parse(read("s.json"));
    EXPECT_GT(stats["iterations"], 2); // the scene's number does not count
    const auto lines = json_lines(outcome.err);
    EXPECT_GE(lines.back()["seconds"], 1.5);
    // Whichever comes first: one iteration is far less than a minute.
    expect_done(run({"render", "scene.xml", "-t", "60", "-n", "1", "-o", "a.pfm", "--stats", "s.json"}));
    EXPECT_EQ(nlohmann::json::parse(read("s.json"))["iterations"], 1);
}

TEST_F(CliRender, json_progress_is_all_that_stderr_holds)
{
    const Outcome outcome = run({"render", "scene.xml", "-n", "5", "-o", "a.pfm", "--progress", "json"});
    expect_done(outcome);
    const auto lines = json_lines(outcome.err);
    EXPECT_EQ(lines.size(), static_cast<std::size_t>(std::count(outcome.err.begin(), outcome.err.end(), '\n')));
    EXPECT_EQ(lines.front()["iterations"], 0);
    EXPECT_EQ(lines.back()["iterations"], 5);
    EXPECT_EQ(lines.back()["fraction"], 1.0);
}

TEST_F(CliRender, an_interrupted_render_saves_what_was_done)
{
    for (int signal : {SIGINT, SIGTERM}) {
        const Interruption after_three{[](const std::string& err) { return most_iterations(err) >= 3; }, signal};
        const Outcome outcome = run({"render", "scene.xml", "-n", "1000000000", "-o", "a.exr", "-o", "a.pfm", "--stats", "s.json", "--progress", "json"}, {}, after_three);
        EXPECT_EQ(outcome.status, 130) << outcome.err;
        EXPECT_THAT(files(), ElementsAre("a.exr", "a.pfm", "s.json", "scene.xml"));
        const auto done = nlohmann::json::parse(read("s.json"))["iterations"].get<std::uint64_t>();
        EXPECT_GE(done, 3u);
        EXPECT_LT(done, 1000000000u);
        // The image is that of so many iterations, not of a broken one.
        expect_done(run({"render", "scene.xml", "-n", std::to_string(done), "-o", "b.pfm"}));
        EXPECT_TRUE(read("a.pfm") == read("b.pfm"));
        for (const char* name : {"a.exr", "a.pfm", "b.pfm", "s.json"}) std::filesystem::remove(folder / name);
    }
}

TEST_F(CliRender, warnings_have_their_line)
{
    SmallScene scene;
    scene.film = R"(<film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/><string name="file_format" value="openexr"/></film>
<float name="no_such_property" value="3"/>)";
    write("scene.xml", scene.xml());
    const Outcome outcome = run({"render", "scene.xml", "-n", "1", "-o", "a.pfm"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("sundog: warning: "));
    EXPECT_THAT(outcome.err, HasSubstr("no_such_property"));
    EXPECT_THAT(outcome.err, HasSubstr("scene.xml:"));
}

TEST_F(CliRender, info_counts)
{
    const Outcome text = run({"info", "scene.xml"});
    expect_done(text);
    for (const char* part : {"1 mesh", "2 triangles", "1 diffuse", "1 point", "16x12", "box", "path max_depth=4"}) EXPECT_THAT(text.out, HasSubstr(part));
    const auto json = nlohmann::json::parse(run({"info", "scene.xml", "--json"}).out);
    EXPECT_EQ(json["triangles"], 2);
    EXPECT_EQ(json["emitters"]["point"], 1);
    EXPECT_EQ(json["width"], 16);
    EXPECT_EQ(json["bounds"]["lower"], nlohmann::json({-1.0, -1.0, 0.0}));
    EXPECT_GT(json["scene_bytes"], 100);
    EXPECT_EQ(json["integrator"]["method"], "path");
    EXPECT_TRUE(json["warnings"].empty());
    EXPECT_THAT(files(), ElementsAre("scene.xml"));
}

TEST_F(CliRender, methods_and_devices_are_listed)
{
    const Outcome table = run({"methods"});
    expect_done(table);
    for (const char* name : {"path", "ptracer", "pppm", "sppm"}) {
        EXPECT_THAT(table.out, HasSubstr(name));
        const Outcome one = run({"methods", name});
        expect_done(one);
        EXPECT_THAT(one.out, HasSubstr("max_depth = -1"));
        EXPECT_THAT(one.out, HasSubstr("paper: "));
    }
    const Outcome devices = run({"devices"});
    expect_done(devices);
    for (const char* part : {"0: ", "compute units", "memory", "work-groups of", "64-bit atomics"}) EXPECT_THAT(devices.out, HasSubstr(part));
}

TEST_F(CliRender, help_and_version)
{
    EXPECT_THAT(run({"--version"}).out, ::testing::StartsWith("sundog "));
    for (const char* command : {"render", "devices", "methods", "info", "compare", "merge", "bench"}) {
        const Outcome help = run({command, "--help"});
        EXPECT_EQ(help.status, 0);
        EXPECT_THAT(help.out, HasSubstr("sundog " + std::string(command)));
        EXPECT_EQ(help.err, "");
        EXPECT_THAT(run({"--help"}).out, HasSubstr(command));
    }
}

} // namespace
} // namespace sundog::cli
