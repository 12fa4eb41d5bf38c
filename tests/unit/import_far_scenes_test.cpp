// Scenes that are far from the origin of their file: the same as near it.
#include "import/scene_writer.h"
#include "unit/mesh_scene.h"

#include <gmock/gmock.h>

namespace
{

using namespace sundog;
using sundog::testing::expect_near;
using sundog::testing::mesh_of;
using sundog::testing::SceneFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string text(double value)
{
    char digits[64];
    std::snprintf(digits, sizeof digits, "%.17g", value);
    return digits;
}

std::string shape(const std::string& type, const std::string& inside)
{
    return "<shape type=\"" + type + "\">" + inside + "</shape>";
}

std::string to_world(const std::string& inside)
{
    return "<transform name=\"to_world\">" + inside + "</transform>";
}

// A room around (s, s, s) with one of everything that has a place.
class FarRoom
{
public:
    explicit FarRoom(double s) : s_(s)
    {
        std::string corners, triangle = "0 1 2\n";
        for (const auto& [x, y, z] : {Double3{-1, 0.125, 0}, Double3{1, 0.25, 0}, Double3{0, 0.75, -0.5}})
            corners += text(s + x) + " " + text(s + y) + " " + text(s + z) + "\n";
        std::string lines = corners;
        for (std::size_t at = 0; (at = lines.find('\n', at)) != std::string::npos && at + 1 < lines.size();)
            lines.replace(at, 1, "\nv "), at += 3;
        folder_.write("baked.obj", "v " + lines + "f 1 2 3\n");
        folder_.write("own.obj", "v -.5 0 0\nv .5 0 0\nv 0 .5 0\nf 1 2 3\n");
        folder_.write("baked.ply",
                      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
                      "1\nproperty list uchar int vertex_indices\nend_header\n" +
                          corners + "3 " + triangle);
    }

    LoadedScene load(const std::string& more = "") const
    {
        const std::string move = "<translate value=\"" + text(s_) + "\"/>";
        const auto at = [&](double x, double y, double z) {
            return "x=\"" + text(s_ + x) + "\" y=\"" + text(s_ + y) + "\" z=\"" + text(s_ + z) + "\"/>";
        };
        const auto file = [](const std::string& name) { return "<string name=\"filename\" value=\"" + name + "\"/>"; };
        return folder_.load(
            "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"shutter_close\" value=\"1\"/>" +
            to_world("<lookat origin=\"" + text(s_) + " " + text(s_) + " " + text(s_ + 1) + "\" target=\"" + text(s_) + " " + text(s_) +
                     " " + text(s_) + "\"/>") +
            "</sensor>" + shape("cube", "<boolean name=\"flip_normals\" value=\"true\"/>" + to_world(move)) +
            shape("rectangle", "<emitter type=\"area\"/>" + to_world("<scale value=\".25\"/><translate y=\".75\"/>" + move)) +
            shape("sphere", "<float name=\"radius\" value=\".25\"/><point name=\"center\" " + at(0.5, 0, 0)) +
            shape("sphere", to_world("<scale value=\".1\"/><translate x=\".3\"/>" + move)) +
            shape("cylinder",
                  "<float name=\"radius\" value=\".25\"/><point name=\"p0\" " + at(0, -0.5, 0) + "<point name=\"p1\" " + at(0, 0.5, 0)) +
            shape("disk", to_world("<scale value=\".2\"/>" + move)) + shape("obj", file("baked.obj")) + shape("ply", file("baked.ply")) +
            shape("obj", file("own.obj") + to_world("<rotate y=\"1\" angle=\"20\"/>" + move)) + "<shape type=\"shapegroup\" id=\"g\">" +
            shape("obj", file("own.obj")) + "</shape>" + shape("instance", "<ref id=\"g\"/>" + to_world("<scale value=\".5\"/>" + move)) +
            shape("sphere", "<animation name=\"to_world\"><transform time=\"0\"><scale value=\".1\"/>" + move +
                                "</transform><transform time=\"1\"><scale value=\".1\"/><translate x=\".5\"/>" + move +
                                "</transform></animation>") +
            "<emitter type=\"point\"><point name=\"position\" " + at(0, 0.5, 0.5) + "</emitter>" + "<emitter type=\"spot\">" +
            to_world("<rotate x=\"1\" angle=\"30\"/>" + move) + "</emitter>" + "<emitter type=\"directional\">" +
            to_world("<rotate x=\"1\" angle=\"30\"/>" + move) + "</emitter>" + more + "</scene>");
    }

private:
    SceneFolder folder_;
    double s_;
};

void expect_same_places(const Scene& a, const Scene& b, float tolerance)
{
    ASSERT_EQ(a.shapes.size(), b.shapes.size());
    for (std::size_t i = 0; i < a.shapes.size(); i++) {
        SCOPED_TRACE(i);
        expect_near(a.shapes[i].bounds().lower, b.shapes[i].bounds().lower, tolerance);
        expect_near(a.shapes[i].bounds().upper, b.shapes[i].bounds().upper, tolerance);
        const auto *mesh = std::get_if<TriangleMesh>(&a.shapes[i].geometry), *other = std::get_if<TriangleMesh>(&b.shapes[i].geometry);
        if (!mesh) continue;
        ASSERT_EQ(mesh->triangles, other->triangles);
        for (std::size_t v = 0; v < mesh->positions.size(); v++) expect_near(mesh->positions[v], other->positions[v], tolerance);
    }
    ASSERT_EQ(a.instances.size(), b.instances.size());
    for (std::size_t i = 0; i < a.instances.size(); i++)
        for (const double time : {0.0, 0.5, 1.0})
            expect_near(a.instances[i].to_world.at(time).point({1, 1, 1}), b.instances[i].to_world.at(time).point({1, 1, 1}), tolerance);
    ASSERT_EQ(a.emitters.size(), b.emitters.size());
    expect_near(std::get<PointEmitter>(a.emitters[0].model).position, std::get<PointEmitter>(b.emitters[0].model).position, tolerance);
    expect_near(std::get<SpotEmitter>(a.emitters[1].model).position, std::get<SpotEmitter>(b.emitters[1].model).position, tolerance);
    expect_near(std::get<DirectionalEmitter>(a.emitters[2].model).direction, std::get<DirectionalEmitter>(b.emitters[2].model).direction,
                1e-6f);
    expect_near(a.sensor.position, b.sensor.position, tolerance);
    expect_near(a.sensor.axis_z, b.sensor.axis_z, 1e-6f);
}

TEST(ImportFarScenes, AreTheSameAsNearTheOrigin)
{
    const LoadedScene near = FarRoom(0).load();
    EXPECT_THAT(near.warnings, IsEmpty());
    EXPECT_EQ(near.scene.origin, (Double3{0, 0, 0}));
    for (const double s : {30000.0, 1e6, -1e6, 1e9}) {
        SCOPED_TRACE(s);
        const LoadedScene far = FarRoom(s).load();
        EXPECT_EQ(far.scene.origin, (Double3{s, s, s}));
        // Decimal fractions lose what double precision has not at 1e9.
        expect_same_places(near.scene, far.scene, s < 1e9 ? 1e-6f : 1e-5f);
        EXPECT_THAT(far.warnings,
                    ElementsAre(AllOf(HasSubstr("scene.xml: the scene is far from the origin"), HasSubstr("counted from ("))));
    }
}

// What is written is near the origin, and so comes back as the same bits.
TEST(ImportFarScenes, AreWrittenFromTheirOwnOrigin)
{
    const LoadedScene far = FarRoom(1e6).load();
    const SceneFolder folder;
    const std::string xml = write_scene(far.scene, folder.path() / "files");
    EXPECT_THAT(xml, HasSubstr("relative to (1e+06, 1e+06, 1e+06)"));
    const LoadedScene again = folder.load(xml);
    EXPECT_EQ(again.scene.origin, (Double3{0, 0, 0}));
    expect_same_places(far.scene, again.scene, 0.0f);
}

// 16 radii.
TEST(ImportFarScenes, OnlyWhatIsFarForItsSizeMoves)
{
    const auto at = [](double x) {
        return SceneFolder().load("<scene version=\"3.0.0\"><sensor type=\"perspective\"/>" +
                                  shape("sphere", "<emitter type=\"area\"/>" + to_world("<translate x=\"" + text(x) + "\"/>")) +
                                  "</scene>");
    };
    const float radius = std::sqrt(3.0f); // of the box
    EXPECT_EQ(at(15.9 * radius).scene.origin, (Double3{0, 0, 0}));
    EXPECT_EQ(std::get<Sphere>(at(15.9 * radius).scene.shapes[0].geometry).center.x, static_cast<float>(15.9 * radius));
    EXPECT_EQ(at(16.1 * radius).scene.origin, (Double3{28, 0, 0})) << "a multiple of 2";
    // As large as it is far: the ground below a room.
    const std::string ground = shape("rectangle", to_world("<scale value=\"1e6\"/>"));
    EXPECT_EQ(FarRoom(30000).load(ground).scene.origin, (Double3{0, 0, 0}));
    EXPECT_THAT(FarRoom(100000).load(ground).warnings, ElementsAre(AllOf(HasSubstr("coarse"), HasSubstr("in steps of 0.0119"))));
}

// In the space of a group, which its instance brings back.
TEST(ImportFarScenes, GroupsHaveTheirOwnOrigin)
{
    const SceneFolder folder;
    folder.write("m.obj", "v 1000000.125 0 0\nv 1000001.25 0 0\nv 1000000 1.0625 0\nf 1 2 3\n");
    const auto loaded = folder.load(sundog::testing::scene_with(
        "<shape type=\"shapegroup\" id=\"g\">" + shape("obj", "<string name=\"filename\" value=\"m.obj\"/>") + "</shape>" +
        shape("instance", "<ref id=\"g\"/>" + to_world("<translate x=\"-1000000\"/><rotate z=\"1\" angle=\"90\"/>"))));
    EXPECT_EQ(loaded.scene.origin, (Double3{0, 0, 0}));
    const TriangleMesh& mesh = mesh_of(loaded);
    const Transform placed = loaded.scene.instances.at(0).to_world.at(0.0);
    expect_near(placed.point(mesh.positions[0]), {0, 0.125f, 0}, 1e-6f);
    expect_near(placed.point(mesh.positions[1]), {0, 1.25f, 0}, 1e-6f);
    expect_near(placed.point(mesh.positions[2]), {-1.0625f, 0, 0}, 1e-6f);
    EXPECT_THAT(loaded.warnings, IsEmpty());
}

// Nothing finds again what the file has lost.
TEST(ImportFarScenes, FilesOfSinglePrecisionSayWhatTheyLost)
{
    const SceneFolder folder;
    std::string ply =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
        "1\nproperty list uchar int vertex_indices\nend_header\n";
    const auto put = [&](auto value) { ply.append(reinterpret_cast<const char*>(&value), sizeof value); };
    for (const float c : {1e6f, 1e6f, 0.f, 1e6f + 2, 1e6f, 0.f, 1e6f, 1e6f + 2, 0.f}) put(c);
    put(static_cast<unsigned char>(3));
    for (const int i : {0, 1, 2}) put(i);
    folder.write("m.ply", ply);
    const auto loaded = folder.load("<scene version=\"3.0.0\"><sensor type=\"perspective\"/>\n" +
                                    shape("ply", "<string name=\"filename\" value=\"m.ply\"/><emitter type=\"area\"/>") + "</scene>");
    EXPECT_THAT(loaded.warnings, ElementsAre(AllOf(HasSubstr("scene.xml:2: the vertices of"),
                                                   HasSubstr("m.ply are 32-bit numbers up to 1e+06, in steps of 0.119")),
                                             HasSubstr("far from the origin")));
    EXPECT_THAT(loaded.scene.origin, ElementsAre(1000002, 1000002, 0)) << "the middle is at 1000001, the radius 1.4";
}

} // namespace
