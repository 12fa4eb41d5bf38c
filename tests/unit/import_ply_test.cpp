// PLY files: formats, properties, attributes, polygons.
#include "math/srgb.h"
#include "scene/validate.h"
#include "unit/mesh_scene.h"

#include <algorithm>
#include <gmock/gmock.h>

namespace
{

using namespace sundog;
using sundog::testing::error_of_mesh;
using sundog::testing::expect_complete;
using sundog::testing::expect_near;
using sundog::testing::expect_uv;
using sundog::testing::load_mesh;
using sundog::testing::mesh_of;
using sundog::testing::triangle_normal;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string ply_header(const std::string& format, int vertices, int faces, const std::string& more = "", const std::string& of_face = "")
{
    return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\n" + more + "element face " + std::to_string(faces) +
           "\nproperty list uchar int vertex_indices\n" + of_face + "end_header\n";
}

constexpr const char* normals = "property float nx\nproperty float ny\nproperty float nz\n";

// Appends numbers as bytes, of either order.
class Bytes
{
public:
    explicit Bytes(std::string header, bool swap = false) : content(std::move(header)), swap_(swap) {}

    template <class T> Bytes& put(T value)
    {
        std::string bytes(reinterpret_cast<const char*>(&value), sizeof(value));
        if (swap_) std::reverse(bytes.begin(), bytes.end());
        content += bytes;
        return *this;
    }

    std::string content;

private:
    bool swap_;
};

std::string binary_triangle(const std::string& format, bool swap)
{
    Bytes ply(ply_header(format, 3, 1, normals), swap);
    const float corners[3][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    for (const auto& corner : corners) {
        for (float c : corner) ply.put(c);
        ply.put(0.6f).put(0.0f).put(0.8f);
    }
    ply.put(static_cast<unsigned char>(3));
    for (int i = 0; i < 3; i++) ply.put(i);
    return ply.content;
}

TEST(ImportPly, Text)
{
    const auto loaded = load_mesh("q.ply", ply_header("ascii", 4, 1) + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
    EXPECT_EQ(mesh_of(loaded).positions.size(), 4u);
    EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 1.0, 1e-6);
    expect_near(triangle_normal(mesh_of(loaded), 0), {0, 0, 1}, 0);
    EXPECT_THAT(mesh_of(loaded).uvs, IsEmpty());
    EXPECT_THAT(mesh_of(loaded).attributes, IsEmpty());
    EXPECT_THAT(loaded.warnings, IsEmpty());
}

TEST(ImportPly, BinaryOfBothByteOrders)
{
    for (const bool big : {false, true}) {
        const auto loaded = load_mesh("t.ply", binary_triangle(big ? "binary_big_endian" : "binary_little_endian", big));
        EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 2.0, 1e-6);
        ASSERT_EQ(mesh_of(loaded).normals.size(), 3u);
        expect_near(mesh_of(loaded).normals[1], {0.6f, 0, 0.8f}, 1e-6f);
    }
}

TEST(ImportPly, TruncationIsAnErrorAtAnyLength)
{
    const std::string whole = binary_triangle("binary_little_endian", false);
    for (std::size_t size = 0; size < whole.size(); size++)
        EXPECT_THROW(load_mesh("t.ply", whole.substr(0, size)), SceneError) << size << " of " << whole.size();
}

// Mixed types, a foreign list before the indices, faces before vertices, an element in between.
TEST(ImportPly, AnyOrderOfElementsAndProperties)
{
    Bytes ply("ply\nformat binary_big_endian 1.0\ncomment odd\nelement face 2\nproperty list ushort double weights\n"
              "property uchar flags\nproperty list uint short vertex_index\nelement edge 1\nproperty int a\nproperty list uchar int b\n"
              "element vertex 4\nproperty double y\nproperty list char char tags\nproperty short z\nproperty float x\nend_header\n",
              true);
    const short faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (const auto& face : faces) {
        ply.put<std::uint16_t>(2).put(0.5).put(0.25).put<std::uint8_t>(9).put<std::uint32_t>(3);
        for (short v : face) ply.put(v);
    }
    ply.put<std::int32_t>(7).put<std::uint8_t>(1).put<std::int32_t>(8);
    const double corners[4][2] = {{0, 0}, {3, 0}, {3, 2}, {0, 2}};
    for (const auto& [x, y] : corners) ply.put(y).put<std::int8_t>(1).put<std::int8_t>(5).put<std::int16_t>(-4).put(static_cast<float>(x));
    const auto loaded = load_mesh("o.ply", ply.content);
    EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 6.0, 1e-5);
    expect_near(mesh_of(loaded).positions[2], {3, 2, -4}, 0);
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("elements 'edge'"), HasSubstr("'tags' of the elements 'vertex'"),
                                             HasSubstr("'weights', 'flags' of the elements 'face' of the PLY file are not used")));
}

TEST(ImportPly, TextureCoordinatesByEachName)
{
    for (const auto& [u, v] : {std::pair{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}}) {
        const std::string content = ply_header("ascii", 3, 1, std::string("property float ") + u + "\nproperty float " + v + "\n") +
                                    "0 0 0 0.25 0.5\n1 0 0 1 0\n0 1 0 0 2\n3 0 1 2\n";
        const auto loaded = load_mesh("t.ply", content);
        ASSERT_EQ(mesh_of(loaded).uvs.size(), 3u) << u;
        expect_uv(mesh_of(loaded).uvs[0], {0.25f, 0.5f});
        expect_uv(mesh_of(loaded).uvs[2], {0, 2});
        EXPECT_THAT(mesh_of(loaded).attributes, IsEmpty());
        const auto flipped = load_mesh("t.ply", content, "<boolean name=\"flip_tex_coords\" value=\"true\"/>");
        expect_uv(mesh_of(flipped).uvs[2], {0, -1});
    }
}

// Mitsuba 3: integers are normalized and sRGB-encoded, floats taken as they are. 0.6: srgb says which.
TEST(ImportPly, VertexColors)
{
    const auto content = [](const std::string& type, const std::string& names) {
        std::string properties;
        for (const char channel : {'r', 'g', 'b'})
            properties += "property " + type + " " +
                          (names == "short" ? std::string(1, channel)
                                            : (names == "0.6" ? "diffuse_" : "") + std::string(channel == 'r'   ? "red"
                                                                                               : channel == 'g' ? "green"
                                                                                                                : "blue")) +
                          "\n";
        const std::string color = type == "uchar" ? " 255 51 0\n" : " 1 0.2 0\n";
        return ply_header("ascii", 3, 1, properties) + "0 0 0" + color + "1 0 0" + color + "0 1 0" + color + "3 0 1 2\n";
    };
    const auto green = [](const LoadedScene& loaded) {
        const auto& attributes = mesh_of(loaded).attributes;
        EXPECT_EQ(attributes.size(), 1u);
        EXPECT_EQ(attributes.at(0).name, "vertex_color");
        EXPECT_FALSE(attributes.at(0).per_face);
        EXPECT_EQ(attributes.at(0).values.size(), 3u);
        EXPECT_EQ(attributes.at(0).values.at(1).x, 1.0f);
        EXPECT_EQ(attributes.at(0).values.at(1).z, 0.0f);
        return attributes.at(0).values.at(1).y;
    };
    const float decoded = linear_from_srgb(0.2f);
    for (const char* names : {"short", "long", "0.6"}) {
        EXPECT_FLOAT_EQ(green(load_mesh("c.ply", content("uchar", names))), decoded) << names;
        EXPECT_FLOAT_EQ(green(load_mesh("c.ply", content("float", names))), 0.2f) << names;
    }
    EXPECT_FLOAT_EQ(green(load_mesh("c.ply", content("float", "long"), "", "0.6.0")), decoded);
    EXPECT_FLOAT_EQ(green(load_mesh("c.ply", content("uchar", "long"), "<boolean name=\"srgb\" value=\"false\"/>", "0.6.0")), 0.2f);
}

TEST(ImportPly, GroupsOfPropertiesAreAttributes)
{
    const std::string of_vertex =
        "property float wear_x\nproperty float heat_0\nproperty float heat_1\nproperty float heat_2\nproperty float "
        "paint_r\nproperty float paint_g\nproperty float paint_b\nproperty float quality\nproperty float pair_x\n"
        "property float pair_y\n";
    const std::string of_face = "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float part_1\n";
    const auto loaded =
        load_mesh("a.ply", ply_header("ascii", 4, 2, of_vertex, of_face) +
                               "0 0 0 .5 1 2 3 .1 .2 .3 9 8 7\n1 0 0 .5 1 2 3 .1 .2 .3 9 8 7\n1 1 0 .5 1 2 3 .1 .2 .3 9 8 7\n"
                               "0 1 0 .25 4 5 6 .4 .5 .6 9 8 7\n4 0 1 2 3 255 0 0 1.5\n3 0 1 2 0 255 0 2.5\n");
    const auto& mesh = mesh_of(loaded);
    expect_complete(mesh);
    const auto value = [&](const std::string& name, std::size_t i) {
        for (const auto& attribute : mesh.attributes)
            if (attribute.name == name) return attribute.values.at(i);
        ADD_FAILURE() << name;
        return Vec3{};
    };
    ASSERT_EQ(mesh.attributes.size(), 5u);
    expect_near(value("vertex_wear", 3), {.25f, .25f, .25f}, 0);
    expect_near(value("vertex_heat", 3), {4, 5, 6}, 0);
    expect_near(value("vertex_paint_color", 3), {.4f, .5f, .6f}, 0);
    expect_near(value("face_color", 1), {1, 0, 0}, 0); // the quad is two triangles
    expect_near(value("face_color", 2), {0, 1, 0}, 0);
    expect_near(value("face_part", 2), {2.5f, 2.5f, 2.5f}, 0);
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("'quality', 'pair_x', 'pair_y' of the elements 'vertex'")));
}

TEST(ImportPly, FaceAttributesStayBesideTheirTriangles)
{
    const auto loaded = load_mesh("d.ply", ply_header("ascii", 4, 3, "", "property float part_x\n") +
                                               "0 0 0\n1 0 0\n2 0 0\n0 1 0\n3 0 1 3 5\n3 0 1 2 6\n3 1 2 3 7\n");
    const auto& mesh = mesh_of(loaded);
    ASSERT_EQ(mesh.triangles.size(), 2u) << "one is degenerate";
    expect_complete(mesh);
    EXPECT_EQ(mesh.attributes[0].values[0].x, 5.0f);
    EXPECT_EQ(mesh.attributes[0].values[1].x, 7.0f);
}

// The area of an arrow head is lost or doubled if a fan starts at the wrong corner.
TEST(ImportPly, ConcavePolygons)
{
    const std::string arrow = "0 0 0\n2 1 0\n0 2 0\n1 1 0\n"; // reflex at the last
    for (int first = 0; first < 4; first++) {
        std::string face = "4";
        for (int i = 0; i < 4; i++) face += " " + std::to_string((first + i) % 4);
        const auto loaded = load_mesh("c.ply", ply_header("ascii", 4, 1) + arrow + face + "\n");
        EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 1.0, 1e-6) << first;
        for (std::size_t i = 0; i < 2; i++) expect_near(triangle_normal(mesh_of(loaded), i), {0, 0, 1}, 1e-6f);
    }
    // A comb with four teeth, seen from below (clockwise), in the plane x = 1.
    std::string comb;
    int corners = 0;
    const auto add = [&](double y, double z) { comb += "1 " + std::to_string(y) + " " + std::to_string(z) + "\n", corners++; };
    add(0, 0);
    for (int tooth = 0; tooth < 4; tooth++) add(tooth, 3), add(tooth + 0.5, 1);
    add(3.5, 0);
    std::string face = std::to_string(corners);
    for (int i = 0; i < corners; i++) face += " " + std::to_string(i);
    const auto loaded = load_mesh("c.ply", ply_header("ascii", corners, 1) + comb + face + "\n");
    // Shoelace: a base of 3.5 x 1 and teeth that are triangles; three of 1/2 (1) 2 and a half one of 1/2 (1/2) 2 at the
    // end, and the first's left half is the border itself.
    EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 3.5 + 4 * 0.5 * 0.5 * 2 + 3 * 0.5 * 0.5 * 2, 1e-5);
    for (std::size_t i = 0; i < mesh_of(loaded).triangles.size(); i++) expect_near(triangle_normal(mesh_of(loaded), i), {-1, 0, 0}, 1e-6f);
}

TEST(ImportPly, CountsThatTheFileCannotHold)
{
    // Were they believed, each would take gigabytes before the end of the file shows.
    const std::string vertices = "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\nproperty float y\n"
                                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    EXPECT_THAT(error_of_mesh("h.ply", vertices + std::string(100, '\0')), HasSubstr("too short for the 2000000000 elements 'vertex'"));
    const std::string text = ply_header("ascii", 3, 2000000000) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_THAT(error_of_mesh("h.ply", text), HasSubstr("h.ply:12: the file is too short"));
    Bytes list("ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face "
               "1\nproperty list uint int vertex_indices\nend_header\n");
    list.put(0.f).put(0.f).put(0.f).put<std::uint32_t>(4000000000u).put(0).put(0).put(0);
    EXPECT_THAT(error_of_mesh("h.ply", list.content), HasSubstr("ends early"));
    const std::string hollow = "ply\nformat binary_little_endian 1.0\nelement hole 2000000000\nelement vertex 1\nproperty float x\n"
                               "property float y\nproperty float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n";
    EXPECT_THAT(error_of_mesh("h.ply", hollow), HasSubstr("'hole' have no properties"));
}

TEST(ImportPly, FractionalAndNegativeIndices)
{
    const std::string head = ply_header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_THAT(error_of_mesh("i.ply", head + "3 0 1 -1\n"), HasSubstr("i.ply:13: face 1 refers to vertex -1"));
    EXPECT_THAT(error_of_mesh("i.ply", head + "3 0 1 1.5\n"), HasSubstr("refers to vertex 1.5"));
    EXPECT_THAT(error_of_mesh("i.ply", head + "2 0 1\n"), HasSubstr("no faces of three vertices or more"));
    EXPECT_THAT(error_of_mesh("i.ply", head + "4 0 1 2\n"), HasSubstr("fewer values"));
    EXPECT_THAT(error_of_mesh("i.ply", head + "3 0 1 2 0\n"), HasSubstr("more values"));
}

} // namespace
