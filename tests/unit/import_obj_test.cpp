// OBJ files: texture coordinates, shapes, materials, creases.
#include "scene/validate.h"
#include "unit/mesh_scene.h"

#include <gmock/gmock.h>
#include <set>

namespace
{

using namespace sundog;
using sundog::testing::error_of_mesh;
using sundog::testing::expect_complete;
using sundog::testing::expect_near;
using sundog::testing::expect_uv;
using sundog::testing::load_mesh;
using sundog::testing::mesh_of;
using sundog::testing::scene_with;
using sundog::testing::SceneFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ImportObj, TextureCoordinatesAreFlippedUnlessToldOtherwise)
{
    const std::string content = quad + "vt 0 0\nvt 1 0.25 7\nvt 0.5\nf 1/1 2/2 3/-1 4\n";
    for (const char* version : {"3.0.0", "0.6.0"}) {
        const auto loaded = load_mesh("q.obj", content, "", version);
        const auto& uvs = mesh_of(loaded).uvs;
        ASSERT_EQ(uvs.size(), 4u);
        expect_uv(uvs[0], {0, 1});
        expect_uv(uvs[1], {1, 0.75f});
        expect_uv(uvs[2], {0.5f, 1}); // v is 0 where it is not given
        expect_uv(uvs[3], {0, 0});    // no index
    }
    const auto straight = load_mesh("q.obj", content, "<boolean name=\"flip_tex_coords\" value=\"false\"/>");
    expect_uv(mesh_of(straight).uvs[1], {1, 0.25f});
    const auto legacy = load_mesh("q.obj", content, "<boolean name=\"flipTexCoords\" value=\"false\"/>", "0.6.0");
    expect_uv(mesh_of(legacy).uvs[1], {1, 0.25f});
    EXPECT_THAT(mesh_of(load_mesh("q.obj", quad + "vt 0 0\nf 1 2 3\n")).uvs, IsEmpty()) << "not used";
    EXPECT_THAT(error_of_mesh("q.obj", quad + "vt 0 nan\nf 1/1 2/1 3/1\n"), HasSubstr("q.obj:5: texture coordinate 1"));
}

TEST(ImportObj, TextureSeamsSplitVertices)
{
    const auto loaded = load_mesh("s.obj", quad + "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/2 3/1 4/1\n");
    EXPECT_EQ(mesh_of(loaded).positions.size(), 5u) << "the first corner has two texture coordinates";
    expect_complete(mesh_of(loaded));
}

TEST(ImportObj, TextureCoordinatesStayUnderReflections)
{
    const std::string content = quad + "vt 0 1\nvt 1 1\nvt 1 0\nvt 0 0\nf 1/1 2/2 3/3 4/4\n";
    const auto loaded = load_mesh("q.obj", content, "<transform name=\"to_world\"><scale x=\"-1\"/></transform>");
    const auto& mesh = mesh_of(loaded);
    for (std::size_t i = 0; i < 4; i++) expect_uv(mesh.uvs[i], {-mesh.positions[i].x, mesh.positions[i].y});
}

TEST(ImportObj, LinesThatContinue)
{
    const auto loaded = load_mesh("c.obj", "v 0 0 \\\n0\nv 1 0 0\r\nv 1 \\\r\n1 0\nf 1 \\\n2 \\\n3\n");
    EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 0.5, 1e-6);
    EXPECT_THAT(error_of_mesh("c.obj", "v 0 0 \\\n0\nv 1 0 x\n"), HasSubstr("c.obj:3: vertex 2"));
}

// Mitsuba 0.6 counts shapes at g and usemtl, where faces came before.
TEST(ImportObj, ShapeIndexChoosesAPart)
{
    const std::string content = "g first\n" + quad + "f 1 2 3\ng second\nv 0 0 2\nusemtl red\nf 1 3 4\nf 1 2 5\nusemtl blue\nf 2 3 5\n";
    const auto part = [&](int index) {
        return load_mesh("g.obj", content,
                         "<integer name=\"shape_index\" value=\"" + std::to_string(index) + "\"/><bsdf type=\"diffuse\"/>");
    };
    EXPECT_EQ(mesh_of(part(0)).triangles.size(), 1u);
    EXPECT_EQ(mesh_of(part(0)).positions.size(), 3u);
    EXPECT_EQ(mesh_of(part(1)).triangles.size(), 2u);
    EXPECT_EQ(mesh_of(part(2)).triangles.size(), 1u);
    expect_near(mesh_of(part(2)).positions[2], {0, 0, 2}, 0);
    EXPECT_EQ(mesh_of(load_mesh("g.obj", content)).triangles.size(), 4u);
    EXPECT_THAT(error_of_mesh("g.obj", content, "\n<integer name=\"shape_index\" value=\"3\"/>"),
                AllOf(HasSubstr("scene.xml:3: shape_index is 3"), HasSubstr("has 3 shapes")));
    EXPECT_THAT(error_of_mesh("g.obj", content, "<integer name=\"shape_index\" value=\"-1\"/>"), HasSubstr("must be >= 0"));
}

TEST(ImportObj, MaterialsWithTextureCoordinatesAndWarnings)
{
    const SceneFolder folder;
    folder.write("some paint.mtl", "newmtl red\nKd 0.8 0.1 0.1\nmap_Kd red.png\n");
    folder.write("m.obj", "mtllib some paint.mtl\nmtllib missing.mtl\n" + quad +
                              "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl red\nf 1/1 2/2 3/3\nusemtl unheard of\nf 1/1 3/3 4/4\n");
    const std::string shape = "<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/>";
    const auto loaded = folder.load(scene_with(shape + "</shape>"));
    ASSERT_EQ(loaded.scene.shapes.size(), 3u) << "bare, red and the light";
    for (std::size_t i = 0; i < 2; i++) {
        EXPECT_EQ(mesh_of(loaded, i).triangles.size(), 1u);
        EXPECT_EQ(mesh_of(loaded, i).uvs.size(), 3u);
        expect_complete(mesh_of(loaded, i));
    }
    expect_uv(mesh_of(loaded, 0).uvs[2], {0, 0}); // bare: the last corner, flipped
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("missing.mtl"), HasSubstr("material 'unheard of'"), HasSubstr("red.png")));
    const auto bare = folder.load(scene_with(shape + "<boolean name=\"load_materials\" value=\"false\"/></shape>"));
    EXPECT_EQ(bare.scene.shapes.size(), 2u);
}

// Two quads that meet at 60 degrees between their normals, sharing an edge.
const std::string roof = "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv -0.5 0 -0.8660254\nv -0.5 1 -0.8660254\nf 1 3 4 2\nf 1 2 6 5\n";

TEST(ImportObj, MaxSmoothAngleMakesCreases)
{
    const auto with_angle = [](const std::string& value) {
        return load_mesh("roof.obj", roof, "<float name=\"max_smooth_angle\" value=\"" + value + "\"/>");
    };
    const auto smooth = with_angle("61"), creased = with_angle("59");
    EXPECT_EQ(mesh_of(smooth).positions.size(), 6u);
    EXPECT_EQ(mesh_of(creased).positions.size(), 8u);
    const Vec3 up{0, 0, 1}, side{-0.8660254f, 0, 0.5f};
    for (std::size_t i = 0; i < 4; i++)
        for (uint v : mesh_of(creased).triangles[i]) expect_near(mesh_of(creased).normals[v], i < 2 ? up : side, 1e-5f);
    for (std::size_t v = 0; v < 6; v++) {
        const float x = mesh_of(smooth).positions[v].x;
        // On the edge both triangles have a right angle or less; the weights differ between its ends, so the normal is only between.
        if (x == 0.0f) {
            EXPECT_LT(dot(mesh_of(smooth).normals[v], up), 0.99f);
            EXPECT_LT(dot(mesh_of(smooth).normals[v], side), 0.99f);
        } else {
            expect_near(mesh_of(smooth).normals[v], x > 0 ? up : side, 1e-5f);
        }
    }
    const auto legacy = load_mesh("roof.obj", roof, "<float name=\"maxSmoothAngle\" value=\"59\"/>", "0.6.0");
    EXPECT_EQ(mesh_of(legacy).positions.size(), 8u);
}

// Vertices that a file repeats are joined again, except across texture seams.
TEST(ImportObj, MaxSmoothAngleJoinsEqualVertices)
{
    const std::string content = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nvn 1 0 0\n";
    const std::string angle = "<float name=\"max_smooth_angle\" value=\"10\"/>";
    const auto joined = load_mesh("j.obj", content + "f 1//1 2//1 3//1\nf 4//1 5//1 6//1\n", angle);
    EXPECT_EQ(mesh_of(joined).positions.size(), 4u);
    for (const Vec3 n : mesh_of(joined).normals) expect_near(n, {0, 0, 1}, 1e-6f);
    const auto seam = load_mesh("j.obj", content + "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 4/1 5/2 6/1\n", angle);
    EXPECT_EQ(mesh_of(seam).positions.size(), 5u);
    expect_complete(mesh_of(seam));
}

TEST(ImportObj, MaxSmoothAngleErrors)
{
    EXPECT_THAT(error_of_mesh("q.obj", roof, "\n<float name=\"max_smooth_angle\" value=\"181\"/>"),
                HasSubstr("scene.xml:3: 'max_smooth_angle'"));
    EXPECT_THAT(error_of_mesh("q.obj", roof, "<float name=\"max_smooth_angle\" value=\"-1\"/>"), HasSubstr("0 to 180"));
    EXPECT_THAT(
        error_of_mesh("q.obj", roof, "<float name=\"max_smooth_angle\" value=\"5\"/><boolean name=\"face_normals\" value=\"true\"/>"),
        HasSubstr("exclude each other"));
}

} // namespace
