#include "import/serialized.h"

#include "import/inflate_stream.h"
#include "import/text_file.h"

#include <array>
#include <bit>
#include <cstring>

namespace sundog
{

namespace
{

static_assert(std::endian::native == std::endian::little, "the file's numbers are little-endian");

constexpr std::uint16_t magic = 0x041c;
constexpr std::size_t header_size = 4;

enum Flags : std::uint32_t {
    has_normals = 0x1,
    has_uvs = 0x2,
    has_colors = 0x8,
    has_face_normals = 0x10,
    in_doubles = 0x2000, // 0x1000: in floats
};

template <class T> T number_at(std::string_view content, std::size_t offset)
{
    T value;
    std::memcpy(&value, content.data() + offset, sizeof(T));
    return value;
}

class SerializedReader
{
public:
    SerializedReader(const std::filesystem::path& file, std::string_view content, const Double3& origin)
        : where_{file.string(), 0}, content_(content), origin_(origin)
    {
    }

    MeshFile read(const SourceLocation& wanted_at, int shape_index)
    {
        if (content_.size() < header_size) fail("too short for a .serialized mesh: is it truncated?");
        version_ = read_version(0);
        const std::size_t offset = find(wanted_at, shape_index);
        if (offset > content_.size() - header_size) fail("the list of meshes at the end of the file is damaged");
        version_ = read_version(offset);
        InflateStream stream(content_.substr(offset + header_size), where_);
        return read_mesh(stream);
    }

private:
    [[noreturn]] void fail(const std::string& message) const { throw SceneError(where_, message); }

    int read_version(std::size_t offset) const
    {
        if (number_at<std::uint16_t>(content_, offset) != magic) fail("not a .serialized mesh of Mitsuba: it does not begin with 0x041c");
        const auto version = number_at<std::uint16_t>(content_, offset + 2);
        if (version != 3 && version != 4)
            fail("version " + std::to_string(version) + " of the .serialized format is not supported: versions 3 and 4 are");
        return version;
    }

    // Where the mesh begins. The first needs no list of offsets.
    std::size_t find(const SourceLocation& wanted_at, int shape_index) const
    {
        if (shape_index == 0) return 0;
        const std::size_t entry = version_ == 4 ? 8 : 4;
        const std::size_t end = content_.size() - 4;
        const auto count = number_at<std::uint32_t>(content_, end);
        if (count == 0 || count > end / entry) fail("the list of meshes at the end of the file is damaged");
        if (static_cast<std::uint32_t>(shape_index) >= count)
            throw SceneError(wanted_at, "shape_index is " + std::to_string(shape_index) + ", but '" + where_.file + "' has " +
                                            std::to_string(count) + " meshes (counted from 0)");
        const std::size_t place = end - entry * (count - static_cast<std::uint32_t>(shape_index));
        return version_ == 4 ? number_at<std::uint64_t>(content_, place) : number_at<std::uint32_t>(content_, place);
    }

    void skip_name(InflateStream& stream) const
    {
        constexpr int longest = 65536;
        for (int i = 0; i < longest; i++)
            if (stream.value<char>() == '\0') return;
        fail("the name of the mesh is longer than 65536 bytes: is the file damaged?");
    }

    MeshFile read_mesh(InflateStream& stream)
    {
        const auto flags = stream.value<std::uint32_t>();
        if (version_ == 4) skip_name(stream);
        const auto vertices = stream.value<std::uint64_t>();
        const auto triangles = stream.value<std::uint64_t>();
        // A file of 32-bit indices cannot say more; its arrays are read in blocks until it ends.
        if (vertices > 0xffffffffu || triangles > 0xffffffffu) fail("the mesh has more than 2^32 vertices or triangles");
        if (vertices == 0 || triangles == 0) fail("the mesh has no faces");
        MeshFile file;
        file.face_normals = (flags & has_face_normals) != 0;
        TriangleMesh& mesh = file.mesh;
        const bool doubles = (flags & in_doubles) != 0;
        mesh.positions = read_vectors<Vec3>(stream, vertices, doubles, origin_);
        file.single_precision = !doubles;
        if (flags & has_normals) mesh.normals = read_vectors<Vec3>(stream, vertices, doubles);
        if (flags & has_uvs) mesh.uvs = read_vectors<Vec2>(stream, vertices, doubles);
        if (flags & has_colors) mesh.attributes.push_back({"vertex_color", false, read_vectors<Vec3>(stream, vertices, doubles)});
        mesh.triangles = stream.values<std::array<uint, 3>>(triangles);
        stream.finish();
        return file;
    }

    template <class T, class Number> static std::vector<T> read_records(InflateStream& stream, std::size_t count, const Double3& origin)
    {
        constexpr std::size_t numbers = sizeof(T) / sizeof(float), block = std::size_t{1} << 14; // records
        std::vector<T> result;
        std::vector<Number> read;
        while (result.size() < count) {
            read.resize(numbers * std::min(block, count - result.size()));
            stream.read(read.data(), read.size() * sizeof(Number));
            for (std::size_t i = 0; i < read.size(); i += numbers) {
                std::array<float, numbers> record;
                for (std::size_t k = 0; k < numbers; k++) record[k] = static_cast<float>(read[i + k] - origin[k]);
                result.push_back(std::bit_cast<T>(record));
            }
        }
        return result;
    }

    template <class T>
    static std::vector<T> read_vectors(InflateStream& stream, std::size_t count, bool doubles, const Double3& origin = {0, 0, 0})
    {
        return doubles ? read_records<T, double>(stream, count, origin) : read_records<T, float>(stream, count, origin);
    }

    SourceLocation where_;
    std::string_view content_;
    Double3 origin_;
    int version_ = 0;
};

} // namespace

MeshFile parse_serialized(const std::filesystem::path& file, std::string_view content, const SourceLocation& wanted_at, int shape_index,
                          const Double3& origin)
{
    return SerializedReader(file, content, origin).read(wanted_at, shape_index);
}

MeshFile load_serialized(const std::filesystem::path& file, const SourceLocation& wanted_at, int shape_index, const Double3& origin)
{
    return parse_serialized(file, read_text_file(file, wanted_at), wanted_at, shape_index, origin);
}

} // namespace sundog
