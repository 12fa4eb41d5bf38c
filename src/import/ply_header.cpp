#include "import/ply_header.h"

#include "import/text_file.h"

#include <algorithm>

namespace sundog
{

namespace
{

std::optional<PlyType> parse_type(std::string_view name)
{
    if (name == "char" || name == "int8") return PlyType::int8;
    if (name == "uchar" || name == "uint8") return PlyType::uint8;
    if (name == "short" || name == "int16") return PlyType::int16;
    if (name == "ushort" || name == "uint16") return PlyType::uint16;
    if (name == "int" || name == "int32") return PlyType::int32;
    if (name == "uint" || name == "uint32") return PlyType::uint32;
    if (name == "float" || name == "float32") return PlyType::float32;
    if (name == "double" || name == "float64") return PlyType::float64;
    return {};
}

class HeaderReader
{
public:
    HeaderReader(const SourceLocation& file, std::string_view content) : where_(file), content_(content) { where_.line = 0; }

    PlyHeader read()
    {
        if (next_line() != std::vector<std::string_view>{"ply"}) fail("not a PLY file: the first line must be 'ply'");
        for (;;) {
            const auto words = next_line();
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
            if (words[0] == "end_header") break;
            if (words[0] == "format")
                read_format(words);
            else if (words[0] == "element")
                read_element(words);
            else if (words[0] == "property")
                read_property(words);
            else
                fail("unexpected '" + std::string(words[0]) + "' in the header of a PLY file");
        }
        header_.size = position_;
        header_.lines = where_.line;
        require_mesh();
        return std::move(header_);
    }

private:
    [[noreturn]] void fail(const std::string& message) const { throw SceneError(where_, message); }

    std::vector<std::string_view> next_line()
    {
        const std::size_t end = content_.find('\n', position_);
        where_.line++;
        if (end == std::string_view::npos) fail("the header of the PLY file has no end: is it truncated?");
        const auto words = tokens(content_.substr(position_, end - position_));
        position_ = end + 1;
        return words;
    }

    void read_format(const std::vector<std::string_view>& words)
    {
        if (words.size() < 2) fail("the format of the PLY file is missing");
        if (words[1] == "ascii")
            header_.format = PlyFormat::text;
        else if (words[1] == "binary_little_endian")
            header_.format = PlyFormat::little_endian;
        else if (words[1] == "binary_big_endian")
            header_.format = PlyFormat::big_endian;
        else
            fail("unknown PLY format '" + std::string(words[1]) + "'");
        has_format_ = true;
    }

    void read_element(const std::vector<std::string_view>& words)
    {
        const auto count = words.size() == 3 ? parse_integer(words[2]) : std::nullopt;
        if (!count || *count < 0 || *count > 0x7fffffff) fail("an element must have a name and a count up to 2^31");
        header_.elements.push_back({std::string(words[1]), static_cast<std::size_t>(*count), {}});
    }

    void read_property(const std::vector<std::string_view>& words)
    {
        if (header_.elements.empty()) fail("a property must follow an element");
        PlyElement& element = header_.elements.back();
        const bool is_list = words.size() == 5 && words[1] == "list";
        if (!is_list && words.size() != 3) fail("a property must have a type and a name");
        PlyProperty property;
        const auto type = parse_type(words[is_list ? 3 : 1]);
        if (is_list) property.count_type = parse_type(words[2]);
        if (!type || (is_list && !property.count_type)) fail("a property has an unknown type");
        property.type = *type;
        property.name = words.back();
        element.properties.push_back(property);
    }

    void require_mesh()
    {
        where_.line = 0;
        const PlyElement* vertex = header_.find("vertex");
        const PlyElement* face = header_.find("face");
        if (!has_format_) fail("the header of the PLY file names no format");
        for (const auto& element : header_.elements) {
            if (element.properties.empty()) fail("the elements '" + element.name + "' have no properties");
            if (header_.find(element.name) != &element) fail("the elements '" + element.name + "' are declared twice");
        }
        for (const char* name : {"x", "y", "z"})
            if (!vertex || vertex->scalar(name) == PlyElement::none) fail("the PLY file has no vertices with x, y, z");
        const bool lists = face && face->find_list({"vertex_indices", "vertex_index"}) != PlyElement::none;
        if (vertex->count == 0 || !lists || face->count == 0) fail("the mesh has no faces");
        header_.vertices = vertex->count;
    }

    SourceLocation where_;
    std::string_view content_;
    std::size_t position_ = 0;
    bool has_format_ = false;
    PlyHeader header_;
};

} // namespace

std::size_t PlyElement::scalar(std::string_view wanted) const
{
    for (std::size_t i = 0; i < properties.size(); i++)
        if (properties[i].name == wanted && !properties[i].count_type) return i;
    return none;
}

std::size_t PlyElement::find_list(std::initializer_list<std::string_view> names) const
{
    for (std::size_t i = 0; i < properties.size(); i++)
        if (properties[i].count_type && std::find(names.begin(), names.end(), properties[i].name) != names.end()) return i;
    return none;
}

const PlyElement* PlyHeader::find(std::string_view name) const
{
    const auto found = std::find_if(elements.begin(), elements.end(), [&](const auto& e) { return e.name == name; });
    return found == elements.end() ? nullptr : &*found;
}

std::size_t size_of(PlyType type)
{
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return 2;
    case PlyType::float64:
        return 8;
    default:
        return 4;
    }
}

PlyHeader read_ply_header(const SourceLocation& file, std::string_view content)
{
    return HeaderReader(file, content).read();
}

} // namespace sundog
