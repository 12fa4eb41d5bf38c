#include "import/obj.h"

#include "import/text_file.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <tiny_obj_loader.h>

namespace sundog
{

namespace
{

// Checks what tinyobjloader would pass over in silence (it reads a malformed number as 0 and drops faces with
// indices out of range), with the line of the fault.
class ObjCheck
{
public:
    explicit ObjCheck(const std::filesystem::path& file) : where_{file.string(), 0} {}

    void run(std::string_view text)
    {
        while (!text.empty()) {
            const std::size_t end = std::min(text.find('\n'), text.size());
            where_.line++;
            check_line(text.substr(0, end));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        if (faces_ == 0) throw SceneError({where_.file, 0}, "the mesh has no faces");
    }

private:
    void check_line(std::string_view line)
    {
        std::string_view word = next_word(line);
        if (word == "v" || word == "vn")
            check_coordinates(word, line);
        else if (word == "vt")
            texture_coordinates_++;
        else if (word == "f")
            check_face(line);
    }

    static std::string_view next_word(std::string_view& line)
    {
        const std::size_t begin = std::min(line.find_first_not_of(" \t\r"), line.size());
        const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
        const std::string_view word = line.substr(begin, end - begin);
        line.remove_prefix(end);
        return word;
    }

    void check_coordinates(std::string_view kind, std::string_view line)
    {
        (kind == "v" ? positions_ : normals_)++;
        for (int i = 0; i < 3; i++) {
            const std::string_view word = next_word(line);
            const auto value = parse_number(word);
            if (value && std::isfinite(static_cast<float>(*value))) continue;
            const std::string what = kind == "v" ? "vertex " + std::to_string(positions_) : "normal " + std::to_string(normals_);
            throw SceneError(where_, what + " must have three finite numbers" + (word.empty() ? "" : ", got '" + std::string(word) + "'"));
        }
    }

    void check_face(std::string_view line)
    {
        faces_++;
        int corners = 0;
        for (std::string_view word = next_word(line); !word.empty(); word = next_word(line), corners++) {
            const std::size_t first = std::min(word.find('/'), word.size());
            const std::size_t second = std::min(word.find('/', first + 1), word.size());
            check_index(word.substr(0, first), positions_, "vertex");
            if (first < word.size() && second > first + 1)
                check_index(word.substr(first + 1, second - first - 1), texture_coordinates_, "texture coordinate");
            if (second < word.size()) check_index(word.substr(second + 1), normals_, "normal");
        }
        if (corners < 3) throw SceneError(where_, "face " + std::to_string(faces_) + " has fewer than three vertices");
    }

    void check_index(std::string_view text, long long count, const char* kind)
    {
        const auto index = parse_integer(text);
        const std::string face = "face " + std::to_string(faces_);
        if (!index) throw SceneError(where_, face + ": '" + std::string(text) + "' is not the index of a " + kind);
        if (*index == 0 || *index > count || *index < -count)
            throw SceneError(where_, face + " refers to " + kind + " " + std::string(text) + ", but " + std::to_string(count) +
                                         " are defined before it (indices start at 1)");
    }

    SourceLocation where_;
    long long positions_ = 0, normals_ = 0, texture_coordinates_ = 0, faces_ = 0;
};

Vec3 triple(const std::vector<tinyobj::real_t>& values, int index)
{
    const auto i = 3 * static_cast<std::size_t>(index);
    return {values[i], values[i + 1], values[i + 2]};
}

void append_materials(const std::vector<tinyobj::material_t>& materials, ObjFile& result)
{
    for (const auto& material : materials) {
        result.materials.push_back({material.name, {material.diffuse[0], material.diffuse[1], material.diffuse[2]}});
        if (!material.diffuse_texname.empty())
            result.warnings.push_back("material '" + material.name + "': texture '" + material.diffuse_texname +
                                      "' is not supported, using Kd");
        const bool emits = material.emission[0] > 0 || material.emission[1] > 0 || material.emission[2] > 0;
        if (emits || material.dissolve < 1.0f || material.illum >= 3)
            result.warnings.push_back("material '" + material.name + "': only its diffuse colour is used");
    }
}

// One vertex for each distinct triple of indices.
void append_triangles(const tinyobj::attrib_t& attributes, const std::vector<tinyobj::shape_t>& shapes, ObjFile& result)
{
    TriangleMesh& mesh = result.mesh;
    const bool has_normals = !attributes.normals.empty();
    std::map<std::array<int, 3>, uint> vertex_of;
    for (const auto& shape : shapes) {
        const auto& indices = shape.mesh.indices;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            std::array<uint, 3> triangle{};
            for (std::size_t k = 0; k < 3; k++) {
                const tinyobj::index_t& index = indices[i + k];
                const auto [entry, added] =
                    vertex_of.emplace(std::array<int, 3>{index.vertex_index, index.texcoord_index, index.normal_index},
                                      static_cast<uint>(mesh.positions.size()));
                triangle[k] = entry->second;
                if (!added) continue;
                mesh.positions.push_back(triple(attributes.vertices, index.vertex_index));
                if (has_normals)
                    mesh.normals.push_back(index.normal_index >= 0 ? triple(attributes.normals, index.normal_index) : Vec3{0, 0, 0});
            }
            mesh.triangles.push_back(triangle);
            if (!result.materials.empty()) result.material_of_triangle.push_back(shape.mesh.material_ids[i / 3]);
        }
    }
}

} // namespace

ObjFile load_obj(const std::filesystem::path& file, const SourceLocation& wanted_at, bool with_materials)
{
    const std::string text = read_text_file(file, wanted_at);
    ObjCheck(file).run(text);

    std::istringstream stream(text);
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    tinyobj::MaterialFileReader material_reader((file.parent_path() / "").string());
    std::string warning, error;
    const bool loaded =
        tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, with_materials ? &material_reader : nullptr);
    if (!loaded) throw SceneError({file.string(), 0}, error.substr(0, error.find('\n')));

    ObjFile result;
    if (with_materials) {
        std::istringstream lines(warning);
        for (std::string line; std::getline(lines, line);)
            if (!line.empty()) result.warnings.push_back(line);
        append_materials(materials, result);
    }
    append_triangles(attributes, shapes, result);
    return result;
}

} // namespace sundog
