// Mitsuba's .serialized meshes, written here as its format description has them.
#include "scene/validate.h"
#include "unit/mesh_scene.h"

#include <cstdint>
#include <gmock/gmock.h>
#include <random>
#include <zlib.h>

namespace
{

using namespace sundog;
using sundog::testing::error_of_mesh;
using sundog::testing::expect_complete;
using sundog::testing::expect_near;
using sundog::testing::expect_uv;
using sundog::testing::load_mesh;
using sundog::testing::mesh_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string deflated(const std::string& content)
{
    uLongf size = compressBound(content.size());
    std::string result(size, '\0');
    EXPECT_EQ(compress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(content.data()), content.size()),
              Z_OK);
    result.resize(size);
    return result;
}

template <class T> void put(std::string& bytes, T value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

struct Part {
    int version = 4;
    bool doubles = false, normals = false, uvs = false, colors = false, face_normals = false;
    float height = 0; // of a unit square
    std::uint64_t promised_vertices = 4;
    std::uint32_t last_index = 3;

    std::string content() const
    {
        std::string bytes;
        put<std::uint32_t>(bytes, (normals ? 1u : 0u) | (uvs ? 2u : 0u) | (colors ? 8u : 0u) | (face_normals ? 0x10u : 0u) |
                                      (doubles ? 0x2000u : 0x1000u));
        if (version == 4) bytes += std::string("a square") + '\0';
        put<std::uint64_t>(bytes, promised_vertices);
        put<std::uint64_t>(bytes, 2);
        const auto number = [&](double value) { doubles ? put(bytes, value) : put(bytes, static_cast<float>(value)); };
        const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        for (const auto& [x, y] : corners) number(x), number(y), number(height);
        for (int i = 0; normals && i < 4; i++) number(0.6), number(0), number(0.8);
        for (int i = 0; uvs && i < 4; i++) number(corners[i][0]), number(2 * corners[i][1]);
        for (int i = 0; colors && i < 4; i++) number(0.25), number(0.5), number(i);
        for (std::uint32_t index : {0u, 1u, 2u, 0u, 2u, last_index}) put(bytes, index);
        return bytes;
    }

    std::string stream() const
    {
        std::string bytes;
        put<std::uint16_t>(bytes, 0x041c);
        put<std::uint16_t>(bytes, static_cast<std::uint16_t>(version));
        return bytes + deflated(content());
    }
};

std::string file_of(const std::vector<Part>& parts)
{
    std::string bytes;
    std::vector<std::size_t> offsets;
    for (const Part& part : parts) {
        offsets.push_back(bytes.size());
        bytes += part.stream();
    }
    for (std::size_t offset : offsets) {
        if (parts[0].version == 4)
            put<std::uint64_t>(bytes, offset);
        else
            put<std::uint32_t>(bytes, static_cast<std::uint32_t>(offset));
    }
    put<std::uint32_t>(bytes, static_cast<std::uint32_t>(parts.size()));
    return bytes;
}

std::string shape_index(int index)
{
    return "\n<integer name=\"shape_index\" value=\"" + std::to_string(index) + "\"/>";
}

TEST(ImportSerialized, BothVersionsAndPrecisions)
{
    for (const int version : {3, 4})
        for (const bool doubles : {false, true}) {
            Part part;
            part.version = version;
            part.doubles = doubles;
            const auto loaded = load_mesh("m.serialized", file_of({part}));
            const auto& mesh = mesh_of(loaded);
            EXPECT_EQ(mesh.positions.size(), 4u);
            EXPECT_NEAR(surface_area(loaded.scene.shapes[0]), 1.0, 1e-6);
            EXPECT_THAT(mesh.uvs, IsEmpty());
            ASSERT_EQ(mesh.normals.size(), 4u) << "computed";
            expect_near(mesh.normals[1], {0, 0, 1}, 1e-6f);
        }
}

TEST(ImportSerialized, EverythingAVertexCanHave)
{
    for (const bool doubles : {false, true}) {
        Part part;
        part.doubles = doubles;
        part.normals = part.uvs = part.colors = true;
        const auto loaded = load_mesh("m.serialized", file_of({part}));
        const auto& mesh = mesh_of(loaded);
        expect_complete(mesh);
        expect_near(mesh.normals[2], {0.6f, 0, 0.8f}, 1e-6f);
        expect_uv(mesh.uvs[2], {1, 2});
        ASSERT_EQ(mesh.attributes.size(), 1u);
        EXPECT_EQ(mesh.attributes[0].name, "vertex_color");
        EXPECT_FALSE(mesh.attributes[0].per_face);
        expect_near(mesh.attributes[0].values[3], {0.25f, 0.5f, 3}, 0);
    }
}

TEST(ImportSerialized, FaceNormalsByFlagOrParameter)
{
    Part part;
    part.normals = true;
    EXPECT_THAT(mesh_of(load_mesh("m.serialized", file_of({part}), "<boolean name=\"face_normals\" value=\"true\"/>")).normals, IsEmpty());
    part.face_normals = true;
    EXPECT_THAT(mesh_of(load_mesh("m.serialized", file_of({part}))).normals, IsEmpty());
}

TEST(ImportSerialized, ShapeIndexChooses)
{
    for (const int version : {3, 4}) {
        std::vector<Part> parts(3);
        for (int i = 0; i < 3; i++) {
            parts[static_cast<std::size_t>(i)].version = version;
            parts[static_cast<std::size_t>(i)].height = static_cast<float>(10 + i);
        }
        parts[1].doubles = true;
        const std::string file = file_of(parts);
        EXPECT_EQ(mesh_of(load_mesh("m.serialized", file)).positions[0].z, 10.0f);
        for (int i = 0; i < 3; i++)
            EXPECT_EQ(mesh_of(load_mesh("m.serialized", file, shape_index(i))).positions[0].z, static_cast<float>(10 + i)) << version;
        EXPECT_EQ(mesh_of(load_mesh("m.serialized", file, "<integer name=\"shapeIndex\" value=\"2\"/>", "0.6.0")).positions[0].z, 12.0f);
        EXPECT_THAT(error_of_mesh("m.serialized", file, shape_index(3)),
                    AllOf(HasSubstr("scene.xml:3: shape_index is 3"), HasSubstr("has 3 meshes")));
    }
}

TEST(ImportSerialized, ErrorsNameTheFile)
{
    const std::string whole = file_of({Part{}, Part{}});
    EXPECT_THAT(error_of_mesh("m.serialized", "solid stl"), HasSubstr("m.serialized: not a .serialized mesh"));
    EXPECT_THAT(error_of_mesh("m.serialized", "\x1c"), HasSubstr("m.serialized: too short"));
    std::string other = whole;
    other[2] = 9;
    EXPECT_THAT(error_of_mesh("m.serialized", other), HasSubstr("version 9"));
    std::string no_list = whole.substr(0, whole.size() - 1);
    EXPECT_THAT(error_of_mesh("m.serialized", no_list, shape_index(1)), HasSubstr("list of meshes at the end of the file is damaged"));
    Part beyond;
    beyond.last_index = 4;
    EXPECT_THAT(error_of_mesh("m.serialized", file_of({beyond})), HasSubstr("refers to vertex 5, but there are 4"));
    Part infinite;
    infinite.height = INFINITY;
    EXPECT_THAT(error_of_mesh("m.serialized", file_of({infinite})), HasSubstr("vertex 1 is not finite"));
}

// Believed, the first count would take 48 GB, the second 768 GB.
TEST(ImportSerialized, CountsThatTheFileCannotHold)
{
    for (const std::uint64_t vertices : {std::uint64_t{4000000000}, std::uint64_t{1} << 36}) {
        Part part;
        part.promised_vertices = vertices;
        EXPECT_THAT(error_of_mesh("m.serialized", file_of({part})),
                    AllOf(HasSubstr("m.serialized: the mesh"), HasSubstr(vertices > 1ull << 32 ? "2^32" : "ends early")));
    }
}

TEST(ImportSerialized, TruncatedAndDamagedFilesNeverCrash)
{
    Part part;
    part.normals = part.uvs = part.colors = true;
    const std::string whole = file_of({part, part});
    const auto loads = [](const std::string& content, const std::string& inside) {
        try {
            load_mesh("m.serialized", content, inside);
            return true;
        } catch (const SceneError&) {
            return false;
        }
    };
    const std::size_t stream = part.stream().size();
    for (std::size_t size = 0; size < whole.size(); size++) {
        EXPECT_TRUE(size >= stream || !loads(whole.substr(0, size), "")) << size;
        EXPECT_FALSE(loads(whole.substr(0, size), shape_index(1))) << size;
    }
    std::mt19937 random(11);
    int loaded = 0;
    for (int trial = 0; trial < 400; trial++) {
        std::string damaged = whole;
        damaged[random() % damaged.size()] = static_cast<char>(random());
        loaded += loads(damaged, shape_index(static_cast<int>(random() % 2))) ? 1 : 0;
    }
    EXPECT_GT(loaded, 0) << "damage to the other mesh is harmless";
    EXPECT_LT(loaded, 400);
}

// Any bit: the checksum of the deflated data tells, where the data does not.
TEST(ImportSerialized, FlippedBitsAreNoOtherMesh)
{
    Part part;
    part.normals = part.uvs = part.colors = true;
    const std::string file = file_of({part});
    const auto loaded_whole = load_mesh("m.serialized", file);
    const TriangleMesh& whole = mesh_of(loaded_whole);
    std::size_t same = 0;
    for (std::size_t bit = 0; bit < 8 * part.stream().size(); bit++) {
        std::string damaged = file;
        damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
        try {
            // Some bits have no meaning: those that fill the last byte before the checksum.
            const auto loaded = load_mesh("m.serialized", damaged);
            const TriangleMesh& mesh = mesh_of(loaded);
            EXPECT_EQ(mesh.positions, whole.positions) << bit;
            EXPECT_EQ(mesh.normals, whole.normals) << bit;
            EXPECT_EQ(mesh.triangles, whole.triangles) << bit;
            EXPECT_EQ(mesh.attributes[0].values, whole.attributes[0].values) << bit;
            same++;
        } catch (const SceneError& error) {
            EXPECT_THAT(error.what(), HasSubstr("m.serialized: ")) << bit;
        }
    }
    EXPECT_LT(same, 8u);
}

// A megabyte that expands to a gigabyte.
TEST(ImportSerialized, DataThatExpandsLikeNoMesh)
{
    std::string zeros;
    put<std::uint32_t>(zeros, 0x1000u);
    zeros += '\0';
    put<std::uint64_t>(zeros, 20000000);
    put<std::uint64_t>(zeros, 1);
    zeros.resize(300000000);
    std::string file("\x1c\x04\x04\x00", 4);
    EXPECT_THAT(error_of_mesh("m.serialized", file + deflated(zeros)), HasSubstr("m.serialized: the compressed mesh expands to more than"));
    std::string name;
    put<std::uint32_t>(name, 0x1000u);
    name.resize(70000, 'n');
    EXPECT_THAT(error_of_mesh("m.serialized", file + deflated(name)), HasSubstr("m.serialized: the name of the mesh is longer than"));
}

} // namespace
