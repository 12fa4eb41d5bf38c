// What a scene can make the importer open, and how much it can make it read.
#include "unit/scene_folder.h"

#include <gmock/gmock.h>
#include <iostream>
#include <sstream>
#include <sys/stat.h>

namespace
{

using namespace sundog;
using sundog::testing::SceneFolder;
using ::testing::HasSubstr;

void expect_error(const SceneFolder& folder, const std::string& inside, const std::string& part)
{
    try {
        folder.load(sundog::testing::scene_with(inside));
        ADD_FAILURE() << "no error for " << inside;
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr("scene.xml:"));
        EXPECT_THAT(error.what(), HasSubstr(part));
    }
}

TEST(ImportFiles, AbsolutePathsAndParentFoldersAreFine)
{
    const SceneFolder folder;
    const auto mesh = folder.write("meshes/m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    folder.write(
        "parts/i.xml",
        "<scene version=\"3.0.0\"><shape type=\"obj\"><string name=\"filename\" value=\"parts/../meshes/m.obj\"/></shape></scene>");
    const auto loaded = folder.load(
        sundog::testing::scene_with("<include filename=\"meshes/../parts/i.xml\"/><shape type=\"obj\"><string name=\"filename\" value=\"" +
                                    mesh.string() + "\"/></shape>"));
    EXPECT_EQ(loaded.scene.triangle_count(), 4u);
}

// A pipe without a writer would wait for ever, a device never end.
TEST(ImportFiles, DevicesAndPipesAreNotOpened)
{
    const SceneFolder folder;
    const std::string pipe = (folder.path() / "pipe").string();
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", folder.path() / "link");
    for (const std::string& name : {std::string("pipe"), pipe, std::string("/dev/zero"), std::string("link"), std::string("/dev/tty")}) {
        expect_error(folder, "<include filename=\"" + name + "\"/>", name == "/dev/tty" ? "" : "regular files");
        for (const char* type : {"obj", "ply", "serialized"})
            expect_error(folder, "<shape type=\"" + std::string(type) + "\"><string name=\"filename\" value=\"" + name + "\"/></shape>",
                         name);
        expect_error(folder, "<emitter type=\"constant\"><spectrum name=\"radiance\" filename=\"" + name + "\"/></emitter>", name);
        expect_error(folder,
                     "<bsdf type=\"diffuse\" id=\"d\"><texture type=\"bitmap\" name=\"reflectance\"><string name=\"filename\" value=\"" +
                         name + "\"/></texture></bsdf><shape type=\"disk\"><ref id=\"d\"/></shape>",
                     name);
    }
    folder.write("m.obj", "mtllib pipe\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    const auto loaded = folder.load(sundog::testing::scene_with("<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/></shape>"));
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_THAT(loaded.warnings[0].text, HasSubstr("regular files"));
}

TEST(ImportFiles, TheSceneItselfComesFromStandardInputByNameAlone)
{
    const SceneFolder folder;
    const auto pipe = folder.path() / "scene.fifo";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const std::filesystem::path& name : {pipe, std::filesystem::path("/dev/zero"), std::filesystem::path("/dev/stdin")}) {
        try {
            load_scene(name, {});
            FAIL() << name;
        } catch (const SceneError& error) {
            EXPECT_THAT(error.what(), HasSubstr(name == "/dev/stdin" ? "/dev/stdin" : "a scene from a pipe is named -"));
        }
    }
    std::istringstream scene(sundog::testing::scene_with(""));
    auto* const input = std::cin.rdbuf(scene.rdbuf());
    const auto loaded = load_scene("-", {});
    std::cin.rdbuf(input);
    EXPECT_EQ(loaded.scene.shapes.size(), 1u);
}

// A library of an OBJ file is beside it, and not looked for.
TEST(ImportFiles, ImagesOfMaterialLibrariesAreRegularFilesToo)
{
    const SceneFolder folder;
    ASSERT_EQ(::mkfifo((folder.path() / "pipe.png").c_str(), 0600), 0);
    folder.write("m.mtl", "newmtl a\nmap_Kd pipe.png\n");
    folder.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
    const auto loaded = folder.load(sundog::testing::scene_with("<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/></shape>"));
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_THAT(loaded.warnings[0].text, HasSubstr("regular files"));
}

TEST(ImportFiles, ParametersWithinParametersCannotFillTheMemory)
{
    std::string bomb = "<default name=\"a0\" value=\"0123456789\"/>";
    for (int i = 1; i <= 30; i++) {
        bomb += "<default name=\"a" + std::to_string(i) + "\" value=\"";
        for (int k = 0; k < 10; k++) bomb += "$a" + std::to_string(i - 1);
        bomb += "\"/>";
    }
    expect_error(SceneFolder(), bomb, "when parameters are substituted");
}

TEST(ImportFiles, EntitiesAreNotExpanded)
{
    std::string bomb = "<!DOCTYPE scene [<!ENTITY a0 \"boom\">";
    for (int i = 1; i <= 30; i++) {
        bomb += "<!ENTITY a" + std::to_string(i) + " \"";
        for (int k = 0; k < 10; k++) bomb += "&a" + std::to_string(i - 1) + ";";
        bomb += "\">";
    }
    bomb += "<!ENTITY outside SYSTEM \"/etc/passwd\">]>";
    const SceneFolder folder;
    const auto loaded = folder.load(bomb + sundog::testing::scene_with("<shape type=\"disk\" id=\"&a30;&outside;\"/>"));
    EXPECT_EQ(loaded.scene.shapes.at(0).id, "&a30;&outside;");
}

TEST(ImportFiles, IncludesInCirclesAndFansEnd)
{
    const SceneFolder folder;
    folder.write("a.xml", "<scene version=\"3.0.0\"><include filename=\"b.xml\"/></scene>");
    folder.write("b.xml", "<scene version=\"3.0.0\"><include filename=\"./a.xml\"/></scene>");
    std::filesystem::create_symlink("a.xml", folder.path() / "c.xml");
    for (const char* name : {"a.xml", "c.xml"})
        EXPECT_THROW(folder.load(sundog::testing::scene_with("<include filename=\"" + std::string(name) + "\"/>")), SceneError);
    // Each includes the next one ten times: 10^15 files, were they all read.
    for (int i = 0; i < 15; i++) {
        std::string fan = "<scene version=\"3.0.0\">";
        for (int k = 0; k < 10; k++) fan += "<include filename=\"f" + std::to_string(i + 1) + ".xml\"/>";
        folder.write("f" + std::to_string(i) + ".xml", fan + "</scene>");
    }
    folder.write("f15.xml", "<scene version=\"3.0.0\"/>");
    EXPECT_THROW(folder.load(sundog::testing::scene_with("<include filename=\"f1.xml\"/>")), SceneError);
}

} // namespace
