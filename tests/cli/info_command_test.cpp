// sundog info: its three groups of warnings, and scenes that it writes.
#include "cli/sundog_process.h"
#include "cli/small_scene.h"

#include <nlohmann/json.hpp>

namespace {

using namespace sundog::cli;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CliInfo : public InFolder {};

// With what a dump must resolve: a parameter, an include, an alias, and a mesh, placed.
SmallScene intricate_scene()
{
    SmallScene scene;
    scene.integrator = R"(<default name="depth" value="5"/><integrator type="sppm"><integer name="max_depth" value="$depth"/>
<integer name="photons" value="500"/></integrator>)";
    scene.shape = R"(<include filename="part.xml"/><alias id="m" as="n"/><shape type="ply"><string name="filename" value="m.ply"/><ref id="n"/>
<transform name="to_world"><rotate x="1" y=".3" angle="17"/><scale value="1.3"/></transform></shape>
<shape type="sphere"><float name="radius" value=".37"/><bsdf type="dielectric"/><transform name="to_world"><rotate z="1" x="1" angle="33"/></transform></shape>)";
    return scene;
}

constexpr const char* part = R"(<scene version="3.0.0"><bsdf type="diffuse" id="m"><texture type="checkerboard" name="reflectance">
<transform name="to_uv"><scale value="5"/></transform></texture></bsdf></scene>)";

constexpr const char* mesh = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float u\nproperty float v\n"
                             "element face 2\nproperty list uchar int vertex_indices\nend_header\n-1 -1 -.5 0 0\n1 -1 -.5 1 0\n1 1 -.7 1 1\n-1 1 -.5 0 1\n"
                             "3 0 1 2\n3 0 2 3\n";

TEST_F(CliInfo, a_dump_renders_to_the_same_pixels)
{
    write("scene.xml", intricate_scene().xml());
    write("part.xml", part);
    write("m.ply", mesh);
    const Outcome dumped = run({"info", "scene.xml", "-D", "depth=6", "--dump", "out.xml"});
    EXPECT_EQ(dumped.status, 0) << dumped.err;
    EXPECT_THAT(dumped.out, HasSubstr("1 sphere"));
    std::filesystem::create_directory(folder / "moved");
    for (const char* name : {"out.xml", "out-files"}) std::filesystem::rename(folder / name, folder / "moved" / name);
    EXPECT_EQ(run({"render", "scene.xml", "-D", "depth=6", "-s", "3", "-o", "a.pfm"}).status, 0);
    EXPECT_EQ(run({"render", "moved/out.xml", "-s", "3", "-o", "b.pfm"}).status, 0);
    EXPECT_TRUE(read("a.pfm") == read("b.pfm"));
    EXPECT_GT(read("a.pfm").size(), 16u * 12 * 12);
    EXPECT_EQ(run({"render", "moved/out.xml", "-s", "4", "-o", "c.pfm"}).status, 0);
    EXPECT_FALSE(read("a.pfm") == read("c.pfm")) << "the images do not depend on the seed: the comparison shows nothing";
}

TEST_F(CliInfo, a_dump_can_be_printed)
{
    write("scene.xml", intricate_scene().xml());
    write("part.xml", part);
    write("m.ply", mesh);
    const Outcome printed = run({"info", "scene.xml", "--dump", "-"});
    EXPECT_EQ(printed.status, 0) << printed.err;
    EXPECT_THAT(printed.out, ::testing::StartsWith("<?xml"));
    EXPECT_THAT(printed.out, HasSubstr("scene-files/mesh-0.ply"));
    write("again.xml", printed.out);
    EXPECT_EQ(run({"info", "again.xml", "--dump", "-"}).out.size(), printed.out.size()) << "but for the folder's name, as long";
}

TEST_F(CliInfo, a_dump_does_not_overwrite_the_scene)
{
    write("scene.xml", SmallScene().xml());
    expect_failure(run({"info", "scene.xml", "--dump", "./scene.xml"}), 2, {"overwrite"});
    expect_failure(run({"info", "scene.xml", "--json", "--dump", "-"}), 2, {"--json"});
    expect_failure(run({"info", "scene.xml", "--dump", "no/such/folder.xml"}), 5, {"no/such"});
    EXPECT_THAT(files(), ElementsAre("scene.xml"));
    EXPECT_EQ(read("scene.xml"), SmallScene().xml());
}

// A ball and the camera move; the square does not.
SmallScene moving_scene(const std::string& shutter_close)
{
    SmallScene scene;
    scene.sensor_start =
        "<sensor type=\"perspective\"><float name=\"shutter_close\" value=\"" + shutter_close + R"("/><animation name="to_world">
<transform time="0"><lookat origin="0, 0, 4" target="0, 0, 0"/></transform><transform time="1"><lookat origin="1, .3, 4" target=".1, 0, 0"/></transform></animation>)";
    scene.shape +=
        R"(<shape type="sphere"><float name="radius" value=".37"/><animation name="to_world"><transform time="0"><translate x="-.5"/></transform>
<transform time="0.7"><rotate y="1" angle="30"/><translate x=".5"/></transform></animation></shape>)";
    return scene;
}

TEST_F(CliInfo, stand_ins_for_what_is_missing_are_asked_for)
{
    SmallScene scene;
    scene.shape = "\n<shape type=\"sphere\"><bsdf type=\"hair\"/></shape>";
    write("scene.xml", scene.xml());
    const Outcome refused = run({"info", "scene.xml"});
    EXPECT_EQ(refused.status, 3);
    EXPECT_THAT(refused.err, HasSubstr("bsdf plugin 'hair' is not supported"));
    EXPECT_THAT(refused.err, HasSubstr("--allow-missing"));
    const Outcome allowed = run({"info", "scene.xml", "--allow-missing"});
    EXPECT_EQ(allowed.status, 0) << allowed.err;
    EXPECT_THAT(allowed.out, HasSubstr("a diffuse bsdf of reflectance 0.5 stands in for it"));
}

TEST_F(CliInfo, says_what_moves)
{
    write("scene.xml", moving_scene("0.5").xml());
    EXPECT_THAT(run({"info", "scene.xml"}).out, HasSubstr("motion        camera, 1 of 1 instances; shutter 0 to 0.5\n"));
    const auto json = nlohmann::json::parse(run({"info", "scene.xml", "--json"}).out);
    EXPECT_EQ(json["shutter"]["close"], 0.5);
    EXPECT_EQ(json["moving"]["camera"], true);
    EXPECT_EQ(json["moving"]["instances"], 1);
    write("still.xml", moving_scene("0").xml());
    const std::string still = run({"info", "still.xml"}).out;
    EXPECT_THAT(still, ::testing::Not(HasSubstr("motion  ")));
    EXPECT_THAT(still, HasSubstr("sphere' stands still: the shutter is open for no time"));
    EXPECT_THAT(still, HasSubstr("sensor 'perspective' stands still"));
}

TEST_F(CliInfo, a_dump_of_what_moves_renders_to_the_same_pixels)
{
    write("scene.xml", moving_scene("0.5").xml());
    EXPECT_EQ(run({"info", "scene.xml", "--dump", "out.xml"}).status, 0);
    EXPECT_THAT(read("out.xml"), HasSubstr("<animation"));
    write("still.xml", moving_scene("0").xml());
    for (const std::string method : {"path", "sppm"}) {
        EXPECT_EQ(run({"render", "scene.xml", "-m", method, "-n", "3", "-o", "a.pfm"}).status, 0);
        EXPECT_EQ(run({"render", "out.xml", "-m", method, "-n", "3", "-o", "b.pfm"}).status, 0);
        EXPECT_TRUE(read("a.pfm") == read("b.pfm")) << method;
        EXPECT_EQ(run({"render", "still.xml", "-m", method, "-n", "3", "-o", "c.pfm"}).status, 0);
        EXPECT_FALSE(read("a.pfm") == read("c.pfm")) << method;
    }
}

TEST_F(CliInfo, warnings_come_in_groups)
{
    SmallScene scene;
    scene.extra = R"(<shape type="sphere"><float name="wobble" value="3"/><bsdf type="diffuse"><rgb name="reflectance" value="2, 0, 0"/></bsdf></shape>
<emitter type="point"><rgb name="intensity" value="0"/></emitter>)";
    write("scene.xml", scene.xml());
    const Outcome text = run({"info", "scene.xml"});
    EXPECT_EQ(text.status, 0);
    EXPECT_THAT(text.out, ::testing::ContainsRegex("ignored +1\n +scene.xml:[0-9]+: .*wobble.*\napproximated +1\n +scene.xml:[0-9]+: .*clamped.*\nnotes +1\n +scene.xml:[0-9]+: "));
    const auto json = nlohmann::json::parse(run({"info", "scene.xml", "--json"}).out);
    for (const char* group : {"ignored", "approximated", "notes"}) EXPECT_EQ(json[group].size(), 1u) << group;
    EXPECT_EQ(json["warnings"].size(), 3u);
    EXPECT_GE(json["load_seconds"], 0.0);
    EXPECT_GT(json["host_bytes"], json["scene_bytes"]);
}

// Once, by info as by a render that traces photons; path has none that could be too few.
TEST_F(CliInfo, photons_spread_over_a_huge_ground_are_told_of)
{
    SmallScene scene;
    scene.extra = R"(<shape type="rectangle"><transform name="to_world"><scale value="500"/><translate z="-2"/></transform></shape>
<emitter type="directional"><vector name="direction" x="0" y="0" z="-1"/></emitter>)";
    write("scene.xml", scene.xml());
    const auto told = ::testing::ContainsRegex("scene.xml:[0-9]+: photons of distant lights .* shows 1/[0-9]+ of it: fewer than one photon in a thousand");
    EXPECT_THAT(run({"info", "scene.xml"}).out, told);
    EXPECT_THAT(run({"render", "scene.xml", "-m", "sppm", "-n", "1", "-o", "a.pfm"}).err, told);
    EXPECT_THAT(run({"render", "scene.xml", "-m", "path", "-n", "1", "-o", "a.pfm"}).err, ::testing::Not(told));
}

} // namespace
