#include "import/obj.h"

#include "import/obj_materials.h"
#include "import/polygon.h"
#include "import/text_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

namespace sundog
{

namespace
{

// Indices from 0 of a face's corner: position, texture coordinate, normal; -1 for none.
using Corner = std::array<int, 3>;

struct CornerHash {
    std::size_t operator()(const Corner& c) const
    {
        std::uint64_t h = 0;
        for (int i : c) h = (h ^ static_cast<std::uint32_t>(i)) * 0x9e3779b97f4a7c15ull;
        return static_cast<std::size_t>(h ^ (h >> 32));
    }
};

// What the lines of one kind define. Of those that are not finite the line is kept, for whoever uses one.
template <class T> class ObjValues
{
public:
    ObjValues(const char* kind, const std::string& file) : kind_(kind), file_(file) {}

    void add(T value, int line)
    {
        if (values_.size() == static_cast<std::size_t>(std::numeric_limits<int>::max()))
            throw SceneError({file_, line}, std::string("a mesh can have 2^31 of each kind of line at most, this is one more ") + kind_);
        if (!all_finite(value)) lines_.emplace(values_.size(), line);
        values_.push_back(value);
    }

    std::size_t size() const { return values_.size(); }

    const T& at(int index) const
    {
        const auto i = static_cast<std::size_t>(index);
        if (const auto bad = lines_.find(i); bad != lines_.end())
            throw SceneError({file_, bad->second}, std::string(kind_) + " " + std::to_string(i + 1) + " is not finite: repair the mesh");
        return values_[i];
    }

private:
    static bool all_finite(Vec3 v) { return is_finite(v); }
    static bool all_finite(Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }

    const char* kind_;
    std::string file_;
    std::vector<T> values_;
    std::unordered_map<std::size_t, int> lines_;
};

class ObjReader
{
public:
    ObjReader(const std::filesystem::path& file, const ObjOptions& options) : file_(file), options_(options), where_{file.string(), 0} {}

    ObjFile read(std::string_view text)
    {
        while (!text.empty()) {
            where_.line++;
            read_line(next_line(text));
        }
        if (faces_ == few_corners_)
            throw SceneError({where_.file, 0}, std::string("the mesh has no faces") + (faces_ > 0 ? " of three vertices or more" : ""));
        if (few_corners_ > 0)
            result_.warnings.emplace_back(std::to_string(few_corners_) + (few_corners_ == 1 ? " face" : " faces") + few_corners_dropped);
        result_.shapes = static_cast<std::size_t>(shape_) + (shape_has_faces_ ? 1 : 0);
        if (!has_uvs_) result_.mesh.uvs.clear();
        if (!has_normals_) result_.mesh.normals.clear();
        assign_materials();
        return std::move(result_);
    }

private:
    // Takes a line off the text, together with those it continues in.
    std::string_view next_line(std::string_view& text)
    {
        std::size_t end = std::min(text.find('\n'), text.size());
        where_.line += continued_lines_;
        continued_lines_ = 0;
        for (std::size_t begin = 0; end < text.size() && continues(text.substr(begin, end - begin));) {
            continued_lines_++;
            begin = end + 1;
            end = std::min(text.find('\n', begin), text.size());
        }
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        return line;
    }

    // A comment ends with its line, also if that is a folder's name with a backslash at the end.
    static bool continues(std::string_view line)
    {
        if (begin_of_comment(line) != std::string_view::npos) return false;
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line.ends_with('\\');
    }

    void read_line(std::string_view line)
    {
        line = without_byte_order_mark(line, {where_.file, 0}); // files that were joined have it in their midst
        const std::string_view word = next_word(line);
        if (word == "v")
            positions_.add(read_triple("vertex", positions_.size(), without_comment(line), options_.origin), where_.line);
        else if (word == "vn")
            normals_.add(read_triple("normal", normals_.size(), without_comment(line)), where_.line);
        else if (word == "vt")
            read_uv(without_comment(line));
        else if (word == "f")
            read_face(without_comment(line));
        else if (word == "g")
            begin_shape();
        else if (word == "usemtl")
            use_material(rest_of(line));
        else if (word == "mtllib" && options_.with_materials)
            append_materials(file_, rest_of(line), result_);
    }

    // Where it begins, or npos. Numbers that are none can have a # too, as 1.#QNAN.
    static std::size_t begin_of_comment(std::string_view line)
    {
        std::size_t begin = line.find('#');
        while (begin != std::string_view::npos && begin > 0 && line[begin - 1] == '.') begin = line.find('#', begin + 1);
        return begin;
    }

    static std::string_view without_comment(std::string_view line) { return line.substr(0, begin_of_comment(line)); }

    static std::string_view next_word(std::string_view& line)
    {
        constexpr std::string_view blanks = " \t\r\n\\";
        const std::size_t begin = std::min(line.find_first_not_of(blanks), line.size());
        const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
        const std::string_view word = line.substr(begin, end - begin);
        line.remove_prefix(end);
        return word;
    }

    static std::string_view rest_of(std::string_view line)
    {
        const std::size_t begin = std::min(line.find_first_not_of(" \t\r"), line.size());
        return line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin);
    }

    // NaN for what is written as a number but is not a finite one: an error only where a face uses it.
    float read_number(const char* kind, std::size_t index, std::string_view word, const char* wanted, double origin = 0.0) const
    {
        const auto value = parse_number(word);
        if (value && std::isfinite(static_cast<float>(*value))) return static_cast<float>(*value - origin);
        if (value || is_not_finite(word)) return std::numeric_limits<float>::quiet_NaN();
        throw SceneError(where_, std::string(kind) + " " + std::to_string(index + 1) + " must have " + wanted +
                                     (word.empty() ? "" : ", got '" + std::string(word) + "'"));
    }

    Vec3 read_triple(const char* kind, std::size_t index, std::string_view line, const Double3& origin = {0, 0, 0}) const
    {
        std::array<float, 3> v{};
        for (std::size_t i = 0; i < 3; i++) v[i] = read_number(kind, index, next_word(line), "three finite numbers", origin[i]);
        return {v[0], v[1], v[2]};
    }

    void read_uv(std::string_view line)
    {
        constexpr const char* kind = "texture coordinate";
        const float u = read_number(kind, uvs_.size(), next_word(line), "finite numbers");
        const std::string_view second = next_word(line);
        const float v = second.empty() ? 0.0f : read_number(kind, uvs_.size(), second, "finite numbers");
        uvs_.add({u, options_.flip_tex_coords ? 1.0f - v : v}, where_.line);
    }

    void read_face(std::string_view line)
    {
        faces_++;
        corners_.clear();
        for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) corners_.push_back(read_corner(word));
        if (corners_.size() < 3) {
            few_corners_++;
            return;
        }
        shape_has_faces_ = true;
        if (options_.shape_index && *options_.shape_index != shape_) return;

        polygon_.clear();
        for (const Corner& corner : corners_) polygon_.push_back(vertex_of(corner));
        if (!append_polygon(result_.mesh.positions, polygon_, result_.mesh.triangles))
            throw SceneError(where_, "face " + std::to_string(faces_) + " is concave and has more than " +
                                         std::to_string(max_concave_corners) + " vertices: triangulate it");
        if (options_.with_materials) result_.material_of_triangle.resize(result_.mesh.triangles.size(), material_);
    }

    Corner read_corner(std::string_view word) const
    {
        const std::size_t first = std::min(word.find('/'), word.size());
        const std::size_t second = std::min(word.find('/', first + 1), word.size());
        Corner corner{read_index(word.substr(0, first), positions_.size(), "vertex"), -1, -1};
        if (first < word.size())
            corner[1] = read_optional_index(word.substr(first + 1, second - first - 1), uvs_.size(), "texture coordinate");
        if (second < word.size()) corner[2] = read_optional_index(word.substr(second + 1), normals_.size(), "normal");
        return corner;
    }

    // Exporters write 1//, 1/1/ and 1/0/1 for a corner that has none.
    int read_optional_index(std::string_view text, std::size_t defined, const char* kind) const
    {
        return text.empty() || text == "0" ? -1 : read_index(text, defined, kind);
    }

    // Counted from 0.
    int read_index(std::string_view text, std::size_t defined, const char* kind) const
    {
        const auto count = static_cast<long long>(defined);
        const auto index = parse_integer(text);
        if (!index)
            throw SceneError(where_, "face " + std::to_string(faces_) + ": '" + std::string(text) + "' is not the index of a " + kind);
        if (*index == 0 || *index > count || *index < -count)
            throw SceneError(where_, "face " + std::to_string(faces_) + " refers to " + kind + " " + std::string(text) + ", but " +
                                         std::to_string(count) + " are defined before it (indices start at 1)");
        return static_cast<int>(*index > 0 ? *index - 1 : count + *index);
    }

    uint vertex_of(const Corner& corner)
    {
        TriangleMesh& mesh = result_.mesh;
        const auto [entry, added] = vertices_.emplace(corner, static_cast<uint>(mesh.positions.size()));
        if (added) {
            const auto [position, uv, index] = corner;
            const int normal = options_.with_normals ? index : -1;
            mesh.positions.push_back(positions_.at(position));
            mesh.uvs.push_back(uv >= 0 ? uvs_.at(uv) : Vec2{0, 0});
            mesh.normals.push_back(normal >= 0 ? normals_.at(normal) : Vec3{0, 0, 0});
            has_uvs_ = has_uvs_ || uv >= 0;
            has_normals_ = has_normals_ || normal >= 0;
        }
        return entry->second;
    }

    void begin_shape()
    {
        if (shape_has_faces_) shape_++;
        shape_has_faces_ = false;
    }

    void use_material(std::string_view name)
    {
        begin_shape();
        const auto [entry, added] = used_materials_.emplace(std::string(name), static_cast<int>(used_materials_.size()));
        material_ = entry->second;
    }

    // -1 for a name that no library has; the last of several.
    int find_material(std::string_view name) const
    {
        for (std::size_t i = result_.materials.size(); i > 0; i--)
            if (result_.materials[i - 1].name == name) return static_cast<int>(i - 1);
        return -1;
    }

    // Names become numbers at the end, as a library may be named after its use.
    void assign_materials()
    {
        if (result_.materials.empty()) {
            result_.material_of_triangle.clear();
            return;
        }
        std::vector<int> number_of(used_materials_.size(), -1);
        for (const auto& [name, used] : used_materials_) {
            int& number = number_of[static_cast<std::size_t>(used)];
            number = find_material(name);
            if (number < 0) number = find_material(rest_of(without_comment(name))); // names can have a # themselves
            if (number < 0)
                result_.warnings.emplace_back("material '" + name + "' is in none of the material libraries", WarningKind::approximated);
        }
        for (int& m : result_.material_of_triangle)
            if (m >= 0) m = number_of[static_cast<std::size_t>(m)];
    }

    std::filesystem::path file_;
    ObjOptions options_;
    SourceLocation where_;
    int continued_lines_ = 0; // of the last line
    ObjValues<Vec3> positions_{"vertex", where_.file}, normals_{"normal", where_.file};
    ObjValues<Vec2> uvs_{"texture coordinate", where_.file};
    std::unordered_map<Corner, uint, CornerHash> vertices_;
    bool has_uvs_ = false, has_normals_ = false;
    std::size_t faces_ = 0, few_corners_ = 0; // among them those of fewer than three
    int shape_ = 0;
    bool shape_has_faces_ = false;
    std::map<std::string, int> used_materials_;
    int material_ = -1;           // among them
    std::vector<Corner> corners_; // of the face that is being read
    std::vector<uint> polygon_;
    ObjFile result_;
};

} // namespace

ObjFile parse_obj(const std::filesystem::path& file, std::string_view content, const ObjOptions& options)
{
    return ObjReader(file, options).read(content);
}

ObjFile load_obj(const std::filesystem::path& file, const SourceLocation& wanted_at, const ObjOptions& options)
{
    return parse_obj(file, read_text_file(file, wanted_at), options);
}

} // namespace sundog
