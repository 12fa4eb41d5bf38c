#include "scene/validate.h"
#include "unit/scene_folder.h"

#include <gmock/gmock.h>
#include <numbers>

namespace
{

using namespace sundog;
using sundog::testing::expect_near;
using sundog::testing::load_with;
using sundog::testing::scene_with;
using sundog::testing::SceneFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const TriangleMesh& mesh_of(const LoadedScene& loaded, std::size_t shape = 0)
{
    return std::get<TriangleMesh>(loaded.scene.shapes.at(shape).geometry);
}

Vec3 triangle_normal(const TriangleMesh& mesh, std::size_t i)
{
    const auto& t = mesh.triangles.at(i);
    return normalize(cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]));
}

// Volume enclosed by a closed mesh: positive when its triangles face outwards.
double signed_volume(const TriangleMesh& mesh)
{
    double sum = 0;
    for (const auto& t : mesh.triangles) sum += dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6.0;
    return sum;
}

LoadedScene load_mesh(const std::string& name, const std::string& content, const std::string& inside = "")
{
    const SceneFolder folder;
    folder.write(name, content);
    const std::string type = name.substr(name.size() - 3);
    return folder.load(scene_with("<shape type=\"" + type + "\"><string name=\"filename\" value=\"" + name + "\"/>" + inside + "</shape>"));
}

constexpr const char* quad_obj = "# a quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

TEST(ImportGeometry, RectangleAndDiskFaceUpTheirZ)
{
    const auto loaded = load_with(R"(<shape type="rectangle"/><shape type="rectangle"><boolean name="flip_normals" value="true"/></shape>
        <shape type="rectangle"><transform name="to_world"><scale x="-3"/></transform></shape>
        <shape type="disk"><transform name="to_world"><scale x="2" y="3" z="-1"/></transform></shape>)");
    for (std::size_t i = 0; i < 2; i++) {
        expect_near(triangle_normal(mesh_of(loaded, 0), i), {0, 0, 1}, 0);
        expect_near(triangle_normal(mesh_of(loaded, 1), i), {0, 0, -1}, 0);
        expect_near(triangle_normal(mesh_of(loaded, 2), i), {0, 0, 1}, 0);
    }
    EXPECT_DOUBLE_EQ(surface_area(loaded.scene.shapes[0]), 4.0);
    const auto& disk = std::get<Disk>(loaded.scene.shapes[3].geometry);
    expect_near(normalize(cross(disk.axis_u, disk.axis_v)), {0, 0, -1}, 0);
    EXPECT_NEAR(surface_area(loaded.scene.shapes[3]), 6 * std::numbers::pi, 1e-5);
}

TEST(ImportGeometry, CubeIsClosedAndFacesOutwards)
{
    const auto loaded =
        load_with(R"(<shape type="cube"/><shape type="cube"><transform name="to_world"><scale x="-2" y="1" z="1"/></transform></shape>
        <shape type="cube"><boolean name="flip_normals" value="true"/></shape>)");
    EXPECT_NEAR(signed_volume(mesh_of(loaded, 0)), 8, 1e-9);
    EXPECT_NEAR(signed_volume(mesh_of(loaded, 1)), 16, 1e-9);
    EXPECT_NEAR(signed_volume(mesh_of(loaded, 2)), -8, 1e-9);
    EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 24, 1e-9);
}

TEST(ImportGeometry, SpheresUnderSimilarities)
{
    const auto loaded = load_with(R"(<shape type="sphere"><point name="center" value="1, 0, 0"/><float name="radius" value="2"/>
        <transform name="to_world"><scale x="-3" y="3" z="3"/><translate z="1"/></transform></shape>)");
    const auto& sphere = std::get<Sphere>(loaded.scene.shapes[0].geometry);
    expect_near(sphere.center, {-3, 0, 1}, 1e-6f);
    EXPECT_FLOAT_EQ(sphere.radius, 6.0f);
    EXPECT_FALSE(sphere.flip_normals);
}

TEST(ImportGeometry, ObjPolygonsNegativeIndicesAndNormals)
{
    const auto quad = load_mesh("quad.obj", quad_obj);
    EXPECT_EQ(mesh_of(quad).triangles.size(), 2u);
    ASSERT_EQ(mesh_of(quad).normals.size(), 4u) << "smooth normals are computed, as in Mitsuba";
    expect_near(mesh_of(quad).normals[2], {0, 0, 1}, 1e-6f);
    EXPECT_THAT(mesh_of(load_mesh("quad.obj", quad_obj, "<boolean name=\"face_normals\" value=\"true\"/>")).normals, IsEmpty());

    const auto pentagon = load_mesh("p.obj", "v 0 0 0\r\nv 2 0 0\r\nv 3 1 0\r\nv 1 2 0\r\nv -1 1 0\r\nf -5 -4 -3 -2 -1\r\n");
    EXPECT_EQ(mesh_of(pentagon).triangles.size(), 3u);
    EXPECT_NEAR(surface_area(pentagon.scene.shapes[0]), 5.0, 1e-6) << "shoelace of the five corners";

    const auto given = load_mesh("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 2\nvn 1 0 1\nf 1//1 2//2 3\n");
    ASSERT_EQ(mesh_of(given).normals.size(), 3u);
    expect_near(mesh_of(given).normals[0], {0, 0, 1}, 1e-6f);
    expect_near(mesh_of(given).normals[1], normalize(Vec3{1, 0, 1}), 1e-6f);
    expect_near(mesh_of(given).normals[2], {0, 0, 1}, 1e-6f);
}

TEST(ImportGeometry, SmoothNormalsAreWeightedByAngle)
{
    // The corner of a cube, its faces cut unevenly into triangles: weighting by angle sees three right angles.
    const auto corner = load_mesh("corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 0\nf 1 3 5\nf 1 5 2\nf 1 2 4\nf 1 4 3\n");
    expect_near(mesh_of(corner).normals[0], normalize(Vec3{-1, -1, -1}), 1e-6f);
}

TEST(ImportGeometry, MeshesUnderReflectionsAndFlips)
{
    const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    const auto mirrored = load_mesh("t.obj", tetrahedron, "<transform name=\"to_world\"><scale y=\"-1\"/></transform>");
    EXPECT_NEAR(signed_volume(mesh_of(mirrored)), 1.0 / 6.0, 1e-6);
    const auto flipped = load_mesh("t.obj", tetrahedron, "<boolean name=\"flip_normals\" value=\"true\"/>");
    EXPECT_NEAR(signed_volume(mesh_of(flipped)), -1.0 / 6.0, 1e-6);
    for (const auto& loaded : {mirrored, flipped})
        for (std::size_t i = 0; i < 4; i++)
            EXPECT_GT(dot(triangle_normal(mesh_of(loaded), i), mesh_of(loaded).normals[mesh_of(loaded).triangles[i][0]]), 0.0f);
}

TEST(ImportGeometry, DegenerateTrianglesAreDroppedAndCounted)
{
    const auto loaded = load_mesh("d.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1e-6 0\nf 1 2 4\nf 1 2 3\nf 1 1 2\nf 1 5 3\n");
    EXPECT_EQ(mesh_of(loaded).triangles.size(), 2u) << "a thin triangle is not degenerate";
    EXPECT_THAT(loaded.warnings, ElementsAre(::testing::AllOf(HasSubstr("scene.xml:2: 2 degenerate triangles"), HasSubstr("d.obj"))));
}

TEST(ImportGeometry, ObjMaterialsMakeOneShapeEach)
{
    const SceneFolder folder;
    folder.write("two.mtl", "newmtl red\nKd 0.8 0.1 0.1\nnewmtl glow\nKd 1.5 0 0\nKe 1 1 1\n");
    folder.write("two.obj", "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nusemtl red\nf 1 3 4\nusemtl glow\nf 1 2 4\n");
    const std::string shape = "<shape type=\"obj\" id=\"m\"><string name=\"filename\" value=\"two.obj\"/>";
    const auto loaded = folder.load(scene_with(shape + "</shape>"));
    ASSERT_EQ(loaded.scene.shapes.size(), 4u) << "bare, red, glow and the light";
    const auto reflectance = [&](std::size_t i) {
        return std::get<DiffuseBsdf>(loaded.scene.bsdfs[loaded.scene.shapes[i].bsdf].model).reflectance;
    };
    expect_near(reflectance(0), {0.5f, 0.5f, 0.5f}, 0);
    expect_near(reflectance(1), {0.8f, 0.1f, 0.1f}, 0);
    expect_near(reflectance(2), {1, 0, 0}, 0);
    EXPECT_EQ(mesh_of(loaded, 1).positions.size(), 3u);
    EXPECT_EQ(mesh_of(loaded, 1).normals.size(), 3u);
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("only its diffuse colour"), HasSubstr("Kd of material 'glow'")));

    const auto painted = folder.load(scene_with(shape + "<bsdf type=\"diffuse\"/></shape>"));
    EXPECT_EQ(painted.scene.shapes.size(), 2u);
    EXPECT_THAT(painted.warnings, IsEmpty());
}

#ifndef SUNDOG_MINIMAL
std::string ply_header(const std::string& format, int vertices, int faces, bool normals)
{
    return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\n" +
           (normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "") + "element face " + std::to_string(faces) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

TEST(ImportGeometry, PlyInText)
{
    const auto loaded = load_mesh("q.ply", ply_header("ascii", 4, 1, false) + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
    EXPECT_EQ(mesh_of(loaded).positions.size(), 4u);
    EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 1.0, 1e-6);
    expect_near(triangle_normal(mesh_of(loaded), 0), {0, 0, 1}, 0);
}

std::string binary_ply()
{
    std::string content = ply_header("binary_little_endian", 3, 1, true);
    const auto put = [&](auto value) { content.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
    const float corners[3][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    for (const auto& corner : corners) {
        for (float c : corner) put(c);
        put(0.6f), put(0.0f), put(0.8f);
    }
    put(static_cast<unsigned char>(3));
    for (int i = 0; i < 3; i++) put(i);
    return content;
}

TEST(ImportGeometry, PlyInBinaryWithNormals)
{
    const auto loaded = load_mesh("t.ply", binary_ply());
    EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 2.0, 1e-6);
    ASSERT_EQ(mesh_of(loaded).normals.size(), 3u);
    expect_near(mesh_of(loaded).normals[1], {0.6f, 0, 0.8f}, 1e-6f);
}

TEST(ImportGeometry, TruncatedPlyIsAnErrorAtAnyLength)
{
    const std::string whole = binary_ply();
    for (std::size_t size = 0; size < whole.size(); size++)
        EXPECT_THROW(load_mesh("t.ply", whole.substr(0, size)), SceneError) << size << " of " << whole.size();
}
#endif

TEST(ImportGeometry, TruncatedObjNeverCrashes)
{
    const std::string whole = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf -1 -2 -3\n";
    int loaded = 0;
    for (std::size_t size = 0; size <= whole.size(); size++) {
        try {
            load_mesh("t.obj", whole.substr(0, size));
            loaded++;
        } catch (const SceneError&) {
        }
    }
    EXPECT_GE(loaded, 4) << "with one whole face, and with two";
}

} // namespace
