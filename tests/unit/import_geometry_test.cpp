#include "scene/validate.h"
#include "unit/mesh_scene.h"

#include <gmock/gmock.h>
#include <numbers>

namespace
{

using namespace sundog;
using sundog::testing::expect_complete;
using sundog::testing::expect_near;
using sundog::testing::expect_uv;
using sundog::testing::load_mesh;
using sundog::testing::load_with;
using sundog::testing::mesh_of;
using sundog::testing::scene_with;
using sundog::testing::SceneFolder;
using sundog::testing::triangle_normal;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Volume enclosed by a closed mesh: positive when its triangles face outwards.
double signed_volume(const TriangleMesh& mesh)
{
    double sum = 0;
    for (const auto& t : mesh.triangles) sum += dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6.0;
    return sum;
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
    expect_near(disk.normal(), {0, 0, -1}, 0);
    expect_near(disk.axis_u, {2, 0, 0}, 0); // texture coordinates begin along the local x, whichever side is out
    expect_near(disk.axis_v, {0, 3, 0}, 0);
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

TEST(ImportGeometry, RectanglesAndCubesHaveTextureCoordinates)
{
    const auto loaded = load_with("<shape type=\"rectangle\"/><shape type=\"cube\"/><shape type=\"cube\"><transform name=\"to_world\">"
                                  "<scale x=\"-1\"/></transform></shape>");
    for (std::size_t i = 0; i < 4; i++) {
        const Vec3 p = mesh_of(loaded, 0).positions[i];
        expect_uv(mesh_of(loaded, 0).uvs[i], {0.5f * (p.x + 1), 0.5f * (p.y + 1)});
    }
    // Facts of Mitsuba 3's cube: which way u and v run on the face with each normal.
    struct Face {
        Vec3 normal, u, v;
    };
    const Face faces[] = {{{0, -1, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                          {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},  {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}};
    const TriangleMesh& cube = mesh_of(loaded, 1);
    ASSERT_EQ(cube.positions.size(), 24u);
    for (std::size_t i = 0; i < cube.triangles.size(); i++) {
        int found = 0;
        for (const Face& face : faces) {
            if (dot(triangle_normal(cube, i), face.normal) < 0.5f) continue;
            found++;
            for (uint v : cube.triangles[i])
                expect_uv(cube.uvs[v], {0.5f * (dot(cube.positions[v], face.u) + 1), 0.5f * (dot(cube.positions[v], face.v) + 1)});
        }
        EXPECT_EQ(found, 1);
    }
    const TriangleMesh& mirrored = mesh_of(loaded, 2);
    expect_complete(mirrored);
    for (std::size_t i = 0; i < 24; i++) {
        expect_uv(mirrored.uvs[i], cube.uvs[i]);
        EXPECT_EQ(mirrored.positions[i].x, -cube.positions[i].x);
    }
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

TEST(ImportGeometry, SpheresKeepTheirRotation)
{
    const auto loaded = load_with(R"(<shape type="sphere"><transform name="to_world"><rotate z="1" angle="90"/><scale x="2" y="2" z="-2"/>
        </transform></shape>)");
    const auto& sphere = std::get<Sphere>(loaded.scene.shapes[0].geometry);
    expect_near(sphere.axis_x, {0, 1, 0}, 1e-6f);
    expect_near(sphere.axis_y, {-1, 0, 0}, 1e-6f);
    expect_near(sphere.axis_z, {0, 0, -1}, 1e-6f);
}

TEST(ImportGeometry, Cylinders)
{
    const auto loaded = load_with(R"(<shape type="cylinder"/>
        <shape type="cylinder"><point name="p0" value="1, 0, 0"/><point name="p1" value="1, 0, 4"/><float name="radius" value="0.5"/>
        <boolean name="flip_normals" value="true"/>
        <transform name="to_world"><scale x="-2" y="2" z="3"/><rotate y="1" angle="90"/><translate y="7"/></transform></shape>)");
    const auto& plain = std::get<Cylinder>(loaded.scene.shapes[0].geometry);
    EXPECT_EQ(plain.radius, 1.0f);
    EXPECT_EQ(plain.length, 1.0f);
    EXPECT_FALSE(plain.flip_normals);
    expect_near(plain.axis_z, {0, 0, 1}, 0);
    EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 2 * std::numbers::pi, 1e-6);
    const auto& moved = std::get<Cylinder>(loaded.scene.shapes[1].geometry);
    expect_near(moved.start, {0, 7, 2}, 1e-6f);
    EXPECT_FLOAT_EQ(moved.length, 12.0f);
    EXPECT_FLOAT_EQ(moved.radius, 1.0f);
    EXPECT_TRUE(moved.flip_normals);
    expect_near(moved.axis_z, {1, 0, 0}, 1e-6f);
    expect_near(moved.axis_x, {0, 0, 1}, 1e-6f); // mirrored
}

// Mitsuba 3.9.1 says so of the same cylinder (its to_world, which holds the radius).
TEST(ImportGeometry, CylindersHaveMitsubasFrame)
{
    const std::string shape = R"(<shape type="cylinder"><point name="p0" value="0.3, -0.2, 0.1"/><point name="p1" value="1.3, 0.7, -0.9"/>
        <float name="radius" value="0.5"/></shape>)";
    const auto loaded = load_with(shape);
    const auto& cylinder = std::get<Cylinder>(loaded.scene.shapes[0].geometry);
    EXPECT_NEAR(cylinder.length, 1.67631f, 1e-5f);
    expect_near(cylinder.axis_x * 0.5f, {0.38855f, -0.100305f, 0.298275f}, 1e-5f);
    expect_near(cylinder.axis_y * 0.5f, {0.100305f, -0.409725f, -0.268447f}, 1e-5f);
    expect_near(cross(cylinder.axis_x, cylinder.axis_y), cylinder.axis_z, 1e-6f);
    // 0.6 takes another frame; it is one all the same.
    const auto old_one = load_with(shape, {}, "0.6.0");
    const auto& legacy = std::get<Cylinder>(old_one.scene.shapes[0].geometry);
    expect_near(legacy.axis_z, cylinder.axis_z, 0);
    expect_near(cross(legacy.axis_x, legacy.axis_y), legacy.axis_z, 1e-6f);
    EXPECT_EQ(legacy.axis_y.y, 0.0f) << "|z.x| > |z.y|";
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
        return std::get<DiffuseBsdf>(loaded.scene.bsdfs[loaded.scene.shapes[i].bsdf].model).reflectance.value;
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
