// Exit status 3: scenes that cannot be rendered, with the file and the line.
#include "cli/small_scene.h"
#include "cli/sundog_process.h"

namespace sundog::cli {
namespace {

using Files = std::map<std::string, std::string>;

struct SceneCase {
    const char* name;
    Files files;
    std::vector<std::string> message;
    std::vector<std::string> arguments = {};
};

void PrintTo(const SceneCase& test, std::ostream* out) { *out << test.name; }

// The small scene with one part replaced.
Files with(std::string SmallScene::*part, const std::string& text, Files others = {})
{
    SmallScene scene;
    scene.*part = text;
    others["scene.xml"] = scene.xml();
    return others;
}

Files with_mesh(const std::string& kind, const std::string& file, const std::string& content)
{
    return with(&SmallScene::shape, "<shape type=\"" + kind + "\"><string name=\"filename\" value=\"" + file + "\"/></shape>", {{file, content}});
}

Files with_film(const std::string& width, const std::string& height)
{
    return with(&SmallScene::film, "<film type=\"hdrfilm\"><integer name=\"width\" value=\"" + width + "\"/><integer name=\"height\" value=\"" + height +
                                       "\"/></film>");
}

class SceneErrors : public InFolder, public ::testing::WithParamInterface<SceneCase> {};

TEST_P(SceneErrors, status_3_and_one_line)
{
    for (const auto& [name, text] : GetParam().files) write(name, text);
    std::vector<std::string> arguments{"render", "scene.xml", "-o", "image.pfm"};
    arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
    expect_failure(run(arguments), 3, GetParam().message);
    EXPECT_EQ(files().size(), GetParam().files.size()) << "no output, no temporary file";
}

const char* const triangle_without_vertex = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n";
const char* const triangle_with_nan = "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n";

const SceneCase cases[] = {
    {"missing_scene", {}, {"scene.xml"}},
    {"empty_file", {{"scene.xml", ""}}, {"scene.xml"}},
    {"truncated", {{"scene.xml", "<scene version=\"3.0.0\">\n<sensor type=\"perspective\">\n"}}, {"scene.xml:"}},
    {"no_xml", {{"scene.xml", "this is text\n"}}, {"scene.xml"}},
    {"binary", {{"scene.xml", std::string("\x7f" "ELF\0\1\2\3", 8)}}, {"scene.xml"}},
    {"other_root", {{"scene.xml", "<svg version=\"3.0.0\"/>\n"}}, {"scene.xml:1"}},
    {"unknown_shape", with(&SmallScene::shape, "<shape type=\"teapot\"/>"), {"scene.xml:6", "teapot"}},
    {"unknown_bsdf", with(&SmallScene::shape, "<shape type=\"rectangle\"><bsdf type=\"velvet\"/></shape>"), {"scene.xml:6", "velvet"}},
    {"unknown_emitter", with(&SmallScene::emitter, "<emitter type=\"laser\"/>"), {"scene.xml:7", "laser"}},
    {"unknown_sensor", with(&SmallScene::sensor_start, "<sensor type=\"fisheye\">"), {"scene.xml:3", "fisheye"}},
    {"unknown_element", with(&SmallScene::extra, "<texturf/>"), {"scene.xml:8", "texturf"}},
    {"missing_mesh", with(&SmallScene::shape, "<shape type=\"obj\"><string name=\"filename\" value=\"none.obj\"/></shape>"), {"none.obj"}},
    {"mesh_without_filename", with(&SmallScene::shape, "<shape type=\"obj\"/>"), {"scene.xml:6", "filename"}},
    {"index_out_of_range", with_mesh("obj", "bad.obj", triangle_without_vertex), {"bad.obj"}},
    {"nan_vertex", with_mesh("obj", "bad.obj", triangle_with_nan), {"bad.obj"}},
    {"broken_ply", with_mesh("ply", "bad.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"), {"bad.ply"}},
    {"zero_film", with_film("0", "12"), {"scene.xml:"}},
    {"negative_film", with_film("16", "-12"), {"scene.xml:"}},
    {"film_too_large", with_film("1000000", "1000000"), {"film"}},
    {"size_too_large", with(&SmallScene::extra, ""), {"film"}, {"--size", "1000000x1000000"}},
    {"no_emitter", with(&SmallScene::emitter, ""), {"light"}},
    {"black_emitter", with(&SmallScene::emitter, "<emitter type=\"point\"><rgb name=\"intensity\" value=\"0\"/></emitter>"), {"light"}},
    {"no_sensor", with(&SmallScene::sensor_start, ""), {"sensor"}},
    {"wrong_type", with(&SmallScene::film, "<film type=\"hdrfilm\"><integer name=\"width\" value=\"wide\"/></film>"), {"scene.xml:5", "wide"}},
    {"negative_radius", with(&SmallScene::shape, "<shape type=\"sphere\"><float name=\"radius\" value=\"-1\"/></shape>"), {"scene.xml:6", "radius"}},
    {"cyclic_include", with(&SmallScene::extra, "<include filename=\"scene.xml\"/>"), {"scene.xml"}},
    {"missing_include", with(&SmallScene::extra, "<include filename=\"none.xml\"/>"), {"scene.xml:", "none.xml"}},
    {"undefined_parameter", with(&SmallScene::film, "<film type=\"hdrfilm\"><integer name=\"width\" value=\"$w\"/></film>"), {"scene.xml:5", "$w"}},
    {"dangling_reference", with(&SmallScene::shape, "<shape type=\"rectangle\"><ref id=\"gold\"/></shape>"), {"scene.xml:6", "gold"}},
    {"unknown_method", with(&SmallScene::integrator, "<integrator type=\"magic\"/>"), {"scene.xml:2", "magic"}},
    {"unknown_method_parameter", with(&SmallScene::integrator, "<integrator type=\"sppm\"><float name=\"magic\" value=\"1\"/></integrator>"),
     {"scene.xml:2", "magic"}},
    {"method_parameter_type", with(&SmallScene::integrator, "<integrator type=\"sppm\"><string name=\"alpha\" value=\"big\"/></integrator>"),
     {"scene.xml:2", "alpha", "big"}},
    {"method_parameter_range", with(&SmallScene::integrator, "<integrator type=\"sppm\"><float name=\"alpha\" value=\"3\"/></integrator>"),
     {"scene.xml:2", "alpha", "3"}},
};

INSTANTIATE_TEST_SUITE_P(Cli, SceneErrors, ::testing::ValuesIn(cases), [](const auto& test) { return std::string(test.param.name); });

using SceneFiles = InFolder;

TEST_F(SceneFiles, scene_that_is_a_folder)
{
    std::filesystem::create_directory(folder / "room");
    expect_failure(run({"render", "room", "-o", "a.pfm"}), 3, {"room"});
}

TEST_F(SceneFiles, info_finds_the_same_errors)
{
    SmallScene scene;
    scene.integrator = "<integrator type=\"magic\"/>";
    write("scene.xml", scene.xml());
    expect_failure(run({"info", "scene.xml"}), 3, {"scene.xml:2", "magic"});
    scene = SmallScene{};
    scene.emitter = "";
    write("scene.xml", scene.xml());
    expect_failure(run({"info", "scene.xml"}), 3, {"light"});
}

} // namespace
} // namespace sundog::cli
