// Meshes as exporters write them that need not care: normals that oppose the winding, byte order marks, corners that lack
// a part, values that are not finite where nobody looks.
#include "scene/validate.h"
#include "unit/mesh_scene.h"

#include <gmock/gmock.h>

namespace
{

using namespace sundog;
using sundog::testing::error_of_mesh;
using sundog::testing::expect_complete;
using sundog::testing::expect_near;
using sundog::testing::load_mesh;
using sundog::testing::mesh_of;
using sundog::testing::triangle_normal;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string quad = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";
const std::string both_faces = "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\n";
const std::string face_normals = "<boolean name=\"face_normals\" value=\"true\"/>";

std::string ply(const std::string& more_of_vertices, const std::string& vertices, const std::string& faces, int face_count)
{
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" + more_of_vertices +
           "element face " + std::to_string(face_count) +
           "\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar "
           "green\nproperty uchar blue\nend_header\n" +
           vertices + faces;
}

// Where the first triangle faces, and that of what its normals say.
void expect_front(const LoadedScene& loaded, Vec3 front)
{
    const TriangleMesh& mesh = mesh_of(loaded);
    expect_complete(mesh);
    for (std::size_t i = 0; i < mesh.triangles.size(); i++) expect_near(triangle_normal(mesh, i), front, 1e-6f);
    for (const Vec3 n : mesh.normals) expect_near(n, front, 1e-6f);
}

TEST(ImportOddMeshes, FacesTurnToTheSideOfTheirNormals)
{
    const auto loaded = load_mesh("m.obj", quad + "vn 0 0 -1\n" + both_faces);
    expect_front(loaded, {0, 0, -1});
    EXPECT_THAT(loaded.warnings, ElementsAre(AllOf(HasSubstr("scene.xml:2: 2 of 2 triangles"), HasSubstr("m.obj were turned"))));
    // What mirrors or flips a mesh does so to windings and normals alike.
    const std::string mirror = "<transform name=\"to_world\"><scale z=\"-1\"/></transform>";
    const std::string flip = "<boolean name=\"flip_normals\" value=\"true\"/>";
    expect_front(load_mesh("m.obj", quad + "vn 0 0 -1\n" + both_faces, mirror), {0, 0, 1});
    expect_front(load_mesh("m.obj", quad + "vn 0 0 -1\n" + both_faces, flip), {0, 0, 1});
    expect_front(load_mesh("m.obj", quad + "vn 0 0 1\n" + both_faces, mirror + flip), {0, 0, 1});
}

TEST(ImportOddMeshes, WhereNormalsAreNotUsedTheWindingIsTheSide)
{
    const auto flat = load_mesh("m.obj", quad + "vn 0 0 -1\n" + both_faces, face_normals);
    expect_front(flat, {0, 0, 1});
    EXPECT_THAT(flat.warnings, IsEmpty());
    const auto creased = load_mesh("m.obj", quad + "vn 0 0 -1\n" + both_faces, "<float name=\"max_smooth_angle\" value=\"30\"/>");
    expect_front(creased, {0, 0, 1});
    const auto kept = load_mesh("m.obj", quad + "vn 0 0 -1\n" + both_faces, "<boolean name=\"turn_faces\" value=\"false\"/>");
    EXPECT_THAT(kept.warnings, IsEmpty());
    expect_near(triangle_normal(mesh_of(kept), 0), {0, 0, 1}, 1e-6f);
    expect_near(mesh_of(kept).normals[0], {0, 0, -1}, 1e-6f);
}

// By the majority of the corners that have a normal.
TEST(ImportOddMeshes, EachFaceTurnsForItself)
{
    const auto turned = [](const std::string& first) {
        const auto loaded = load_mesh("m.obj", quad + "vn 0 0 1\nvn 0 0 -1\nvn 1 0 0\n" + first + "\nf 1//1 3//1 4//1\n");
        const TriangleMesh& mesh = mesh_of(loaded);
        expect_near(triangle_normal(mesh, 1), {0, 0, 1}, 1e-6f);
        EXPECT_EQ(loaded.warnings.size(), triangle_normal(mesh, 0).z < 0 ? 1u : 0u);
        return triangle_normal(mesh, 0).z < 0;
    };
    EXPECT_TRUE(turned("f 1//2 2//2 3//2"));
    EXPECT_TRUE(turned("f 1//2 2//2 3//1"));
    EXPECT_FALSE(turned("f 1//2 2//1 3//1"));
    EXPECT_TRUE(turned("f 1//2 2 3")) << "one normal is given, and it opposes";
    EXPECT_FALSE(turned("f 1//2 2//3 3//1")) << "one of three; along the face is no side";
}

TEST(ImportOddMeshes, TurnedFacesKeepWhatIsTheirs)
{
    const std::string normals = "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n";
    const auto loaded = load_mesh("m.ply", ply(normals, "-1 -1 0 0 0 -1 0 0\n1 -1 0 0 0 -1 1 0\n1 1 0 0 0 -1 1 1\n-1 1 0 0 0 -1 0 1\n",
                                               "3 0 1 2 255 0 0\n3 0 2 3 0 255 0\n", 2));
    expect_front(loaded, {0, 0, -1});
    const TriangleMesh& mesh = mesh_of(loaded);
    for (std::size_t i = 0; i < 4; i++)
        sundog::testing::expect_uv(mesh.uvs[i], {0.5f + 0.5f * mesh.positions[i].x, 0.5f + 0.5f * mesh.positions[i].y});
    expect_near(mesh.attributes.at(0).values.at(1), {0, 1, 0}, 0);
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("2 of 2 triangles")));
}

TEST(ImportOddMeshes, ByteOrderMarks)
{
    const std::string mark = "\xef\xbb\xbf";
    const auto plain = load_mesh("m.obj", quad + "f 1 2 3 4\n");
    for (const std::string& content : {mark + quad + "f 1 2 3 4\n", quad + mark + "f 1 2 3 4\n"})
        EXPECT_EQ(mesh_of(load_mesh("m.obj", content)).positions, mesh_of(plain).positions);
    EXPECT_EQ(mesh_of(load_mesh("m.ply", mark + ply("", "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "3 0 1 2 9 9 9\n", 1))).triangles.size(), 1u);
    EXPECT_THAT(error_of_mesh("m.obj", "\xff\xfev"), HasSubstr("m.obj: the file is UTF-16"));
    EXPECT_THAT(error_of_mesh("m.ply", "\xfe\xff"), HasSubstr("m.ply: the file is UTF-16"));

    const sundog::testing::SceneFolder folder;
    folder.write("m.mtl", mark + "newmtl red\nKd 1 0 0\n");
    folder.write("m.obj", "mtllib m.mtl # beside\n" + quad + "usemtl red # of m.mtl\nf 1 2 3 4\n");
    const auto loaded = folder.load(sundog::testing::scene_with("<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/></shape>"));
    EXPECT_THAT(loaded.warnings, IsEmpty());
    EXPECT_EQ(loaded.scene.bsdfs.at(0).id, "red");
}

TEST(ImportOddMeshes, CornersOfObjFacesLackTheirParts)
{
    for (const char* face : {"f 1// 2// 3// 4//", "f 1/0/1 2/0/1 3/0/1 4/0/1", "f 1/1/ 2/1/ 3/1/ 4/1/", "f 1//0 2//1 3//1 4//1",
                             "f 1/ 2/ 3/ 4/", "f 1 2 3 4 # a quad", "f 1 2 3 4# a quad", "f 1 2 3 4 #"}) {
        const auto loaded = load_mesh("m.obj", quad + "vn 0 0 1 # up\nvt 0 0 # corner\n" + face + "\n");
        EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 4.0, 1e-6) << face;
        expect_front(loaded, {0, 0, 1});
        EXPECT_THAT(loaded.warnings, IsEmpty());
    }
    EXPECT_THAT(error_of_mesh("m.obj", quad + "f 0//1 2//1 3//1\n"), HasSubstr("m.obj:5: face 1 refers to vertex 0"));
    EXPECT_THAT(error_of_mesh("m.obj", quad + "f 1//2 2 3\n"), HasSubstr("m.obj:5: face 1 refers to normal 2"));
}

TEST(ImportOddMeshes, FacesOfTwoCornersAreDroppedAndCounted)
{
    const auto obj = load_mesh("m.obj", quad + "f 1 2\nf 1 2 3 4\nf 3\n");
    EXPECT_EQ(mesh_of(obj).triangles.size(), 2u);
    EXPECT_THAT(obj.warnings, ElementsAre(HasSubstr("m.obj: 2 faces of fewer than three vertices dropped")));
    const auto colored = load_mesh("m.ply", ply("", "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "2 0 1 9 9 9\n3 0 1 2 255 0 0\n", 2));
    expect_complete(mesh_of(colored));
    expect_near(mesh_of(colored).attributes.at(0).values.at(0), {1, 0, 0}, 0);
    EXPECT_THAT(colored.warnings, ElementsAre(HasSubstr("m.ply: 1 face of fewer than three vertices dropped")));
}

// The line after it would be lost, and all vertices shifted.
TEST(ImportOddMeshes, ACommentEndsWithItsLine)
{
    const auto loaded = load_mesh("m.obj", "# from C:\\models\\\n" + quad + "f 1 2 3 4 # in C:\\models\\\n");
    EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 4.0, 1e-6);
}

TEST(ImportOddMeshes, ValuesThatAreNotFiniteWhereNobodyLooks)
{
    for (const char* nan : {"nan", "-nan(ind)", "inf", "1.#QNAN", "1e999", "1e39"}) {
        const std::string value = nan;
        const std::string bad_normal = quad + "vn " + value + " 0 0\n" + both_faces;
        EXPECT_EQ(mesh_of(load_mesh("m.obj", bad_normal, face_normals)).triangles.size(), 2u) << nan;
        EXPECT_THAT(error_of_mesh("m.obj", bad_normal), HasSubstr("m.obj:5: normal 1 is not finite")) << nan;
        const auto unused = load_mesh("m.obj", quad + "v " + value + " 0 0\nvt 0 " + value + "\nf 1 2 3 4\n");
        EXPECT_EQ(mesh_of(unused).positions.size(), 4u) << nan;
    }
    const std::string quality = "property float quality\n";
    const auto of_quality = load_mesh("m.ply", ply(quality, "0 0 0 nan\n1 0 0 inf\n1 1 0 -nan\n0 1 0 1\n", "3 0 1 2 9 9 9\n", 1));
    EXPECT_THAT(of_quality.warnings, ElementsAre(HasSubstr("'quality'")));
    const auto of_vertex = load_mesh("m.ply", ply("", "0 0 0\n1 0 0\n1 1 0\n0 nan 0\n", "3 0 1 2 9 9 9\n", 1));
    EXPECT_TRUE(is_finite(mesh_of(of_vertex).positions[3])) << "nothing else needs to know of it";
    const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
    const std::string nan_normal = ply(normals, "0 0 0 0 0 nan\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n", "3 0 1 2 9 9 9\n", 1);
    EXPECT_EQ(mesh_of(load_mesh("m.ply", nan_normal, face_normals)).triangles.size(), 1u);
    EXPECT_THAT(error_of_mesh("m.ply", nan_normal), HasSubstr("m.ply: the normal of vertex 1 is not finite"));
    EXPECT_THAT(error_of_mesh("m.ply", ply("", "0 0 0\n1 0 0\n1 oops 0\n0 0 0\n", "3 0 1 2 9 9 9\n", 1)),
                HasSubstr("'oops' is not a number"));
}

// An attribute may be what it likes, as long as no texture shows it.
TEST(ImportOddMeshes, AttributesThatAreNotFinite)
{
    const std::string heat = ply("property float heat_r\nproperty float heat_g\nproperty float heat_b\n",
                                 "0 0 0 nan 0 0\n1 0 0 0 0 0\n1 1 0 0 0 0\n0 1 0 0 0 0\n", "3 0 1 2 9 9 9\n", 1);
    EXPECT_EQ(mesh_of(load_mesh("m.ply", heat)).triangles.size(), 1u);
    const std::string shows = "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"mesh_attribute\"><string name=\"name\" "
                              "value=\"vertex_heat_color\"/></texture></bsdf>";
    EXPECT_THAT(error_of_mesh("m.ply", heat, shows),
                AllOf(HasSubstr("scene.xml:2: "), HasSubstr("vertex_heat_color"), HasSubstr("not finite")));
}

} // namespace
