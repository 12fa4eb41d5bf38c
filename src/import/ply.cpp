#include "import/ply.h"

#include "import/ply_attributes.h"
#include "import/ply_body.h"
#include "import/polygon.h"
#include "import/text_file.h"
#include "math/srgb.h"

#include <cmath>

namespace sundog
{

namespace
{

// The largest value of an integer type; 0 for floating-point ones.
double largest_integer(PlyType type)
{
    switch (type) {
    case PlyType::int8:
        return 127.0;
    case PlyType::uint8:
        return 255.0;
    case PlyType::int16:
        return 32767.0;
    case PlyType::uint16:
        return 65535.0;
    case PlyType::int32:
        return 2147483647.0;
    case PlyType::uint32:
        return 4294967295.0;
    default:
        return 0.0;
    }
}

class PlyReader
{
public:
    PlyReader(const SourceLocation& where, std::string_view content, const PlyOptions& options)
        : header_(read_ply_header(where, content)), body_(header_, content, where), options_(options)
    {
    }

    MeshFile read()
    {
        std::optional<PlyBody> faces; // that came before the vertices
        for (const auto& element : header_.elements) {
            if (element.name == "vertex") {
                read_vertices(element);
            } else if (element.name == "face" && !file_.mesh.positions.empty()) {
                read_faces(element, body_);
            } else {
                if (element.name == "face")
                    faces = body_;
                else if (element.count > 0)
                    file_.warnings.emplace_back("elements '" + element.name + "' of the PLY file are not used", WarningKind::ignored);
                body_.skip(element);
            }
        }
        if (faces) read_faces(*header_.find("face"), *faces);
        return std::move(file_);
    }

private:
    // Reads the scalars of element i into row_, one a property. `on_list` is given each list and its length, and must
    // read its values.
    template <class OnList> void read_row(PlyBody& body, const PlyElement& element, std::size_t i, OnList on_list)
    {
        body.begin_element();
        for (std::size_t k = 0; k < element.properties.size(); k++) {
            const PlyProperty& property = element.properties[k];
            if (property.count_type) {
                on_list(property, body.next_count(property, element, i));
                continue;
            }
            row_[k] = body.next(property.type);
        }
        body.end_element();
    }

    float number(std::size_t property) const { return static_cast<float>(row_[property]); }

    Vec3 triple(const std::array<std::size_t, 3>& properties, const Double3& origin = {0, 0, 0}) const
    {
        std::array<float, 3> v{};
        for (std::size_t i = 0; i < 3; i++) v[i] = static_cast<float>(row_[properties[i]] - origin[i]);
        return {v[0], v[1], v[2]};
    }

    void read_vertices(const PlyElement& element)
    {
        const auto find_all = [&](const auto&... names) { return std::array{element.scalar(names)...}; };
        const auto complete = [](const auto& list) { return std::find(list.begin(), list.end(), PlyElement::none) == list.end(); };
        const auto position = find_all("x", "y", "z"), normal = find_all("nx", "ny", "nz");
        auto uv = find_all("u", "v");
        if (!complete(uv)) uv = find_all("texture_u", "texture_v");
        if (!complete(uv)) uv = find_all("s", "t");
        const bool with_normals = complete(normal), with_uvs = complete(uv);

        std::vector<std::size_t> taken(position.begin(), position.end());
        if (with_normals) taken.insert(taken.end(), normal.begin(), normal.end());
        if (with_uvs) taken.insert(taken.end(), uv.begin(), uv.end());
        const std::size_t first_attribute = begin_attributes(element, "vertex_", taken);

        body_.begin_elements(element);
        row_.assign(element.properties.size(), 0.0);
        file_.single_precision = header_.format != PlyFormat::text && element.properties[position[0]].type == PlyType::float32;
        TriangleMesh& mesh = file_.mesh;
        mesh.positions.reserve(element.count);
        if (with_normals) mesh.normals.reserve(element.count);
        if (with_uvs) mesh.uvs.reserve(element.count);
        for (std::size_t i = 0; i < element.count; i++) {
            read_row(body_, element, i, [&](const PlyProperty& list, std::size_t count) {
                for (std::size_t k = 0; k < count; k++) body_.next(list.type);
            });
            mesh.positions.push_back(triple(position, options_.origin));
            if (with_normals) mesh.normals.push_back(triple(normal));
            if (with_uvs) mesh.uvs.push_back({number(uv[0]), options_.flip_tex_coords ? 1.0f - number(uv[1]) : number(uv[1])});
            append_attributes(element, first_attribute, 1);
        }
    }

    void read_faces(const PlyElement& element, PlyBody& body)
    {
        const std::size_t indices = element.find_list({"vertex_indices", "vertex_index"});
        const std::size_t first_attribute = begin_attributes(element, "face_", {indices});
        body.begin_elements(element);
        row_.assign(element.properties.size(), 0.0);
        auto& triangles = file_.mesh.triangles;
        triangles.reserve(element.count);
        std::vector<uint> polygon;
        std::size_t few_corners = 0; // faces of fewer than three
        for (std::size_t i = 0; i < element.count; i++) {
            read_row(body, element, i, [&](const PlyProperty& list, std::size_t count) {
                if (&list == &element.properties[indices])
                    read_polygon(body, element, i, list, count, polygon);
                else
                    for (std::size_t k = 0; k < count; k++) body.next(list.type);
            });
            const std::size_t before = triangles.size();
            if (polygon.size() < 3)
                few_corners++;
            else if (!append_polygon(file_.mesh.positions, polygon, triangles))
                body.fail(element_name(element, i) + " is concave and has more than " + std::to_string(max_concave_corners) +
                          " vertices: triangulate it");
            append_attributes(element, first_attribute, triangles.size() - before);
        }
        if (few_corners == element.count) body.fail("the mesh has no faces of three vertices or more");
        if (few_corners > 0)
            file_.warnings.emplace_back(std::to_string(few_corners) + (few_corners == 1 ? " face" : " faces") + few_corners_dropped);
    }

    void read_polygon(PlyBody& body, const PlyElement& element, std::size_t i, const PlyProperty& list, std::size_t count,
                      std::vector<uint>& polygon)
    {
        const auto vertices = static_cast<double>(header_.vertices);
        polygon.clear();
        for (std::size_t k = 0; k < count; k++) {
            const double index = body.next(list.type);
            if (!(index >= 0.0 && index < vertices) || index != std::floor(index)) {
                std::string text = std::to_string(index);
                if (index == std::floor(index)) text.resize(text.find('.'));
                body.fail(element_name(element, i) + " refers to vertex " + text + ", but there are " + std::to_string(header_.vertices) +
                          " (indices start at 0)");
            }
            polygon.push_back(static_cast<uint>(index));
        }
    }

    // Adds the attributes of an element to the mesh, without values. Returns the index of the first.
    std::size_t begin_attributes(const PlyElement& element, const std::string& prefix, const std::vector<std::size_t>& taken)
    {
        const std::size_t first = file_.mesh.attributes.size();
        PlyAttributes found = find_attributes(element, prefix, taken);
        for (const auto& attribute : found.list) file_.mesh.attributes.push_back({attribute.name, prefix == "face_", {}});
        sources_ = std::move(found.list);
        if (!found.unused.empty()) {
            std::string names;
            for (const auto& name : found.unused) names += (names.empty() ? "'" : ", '") + name + "'";
            file_.warnings.emplace_back(names + " of the elements '" + element.name + "' of the PLY file " +
                                     (found.unused.size() == 1 ? "is" : "are") + " not used",
                                     WarningKind::ignored);
        }
        return first;
    }

    void append_attributes(const PlyElement& element, std::size_t first, std::size_t copies)
    {
        for (std::size_t a = 0; a < sources_.size(); a++) {
            const auto& [name, properties, is_color] = sources_[a];
            const Vec3 value{attribute_value(element, properties[0], is_color), attribute_value(element, properties[1], is_color),
                             attribute_value(element, properties[2], is_color)};
            auto& values = file_.mesh.attributes[first + a].values;
            values.insert(values.end(), copies, value);
        }
    }

    float attribute_value(const PlyElement& element, std::size_t property, bool is_color) const
    {
        const double largest = largest_integer(element.properties[property].type);
        const bool is_integer = largest > 0.0;
        const float value = is_integer ? static_cast<float>(number(property) / largest) : number(property);
        // Mitsuba 3 decodes all integers, 0.6 only colours.
        const bool encoded = options_.colors == PlyColors::by_type ? is_integer : is_color && options_.colors == PlyColors::encoded;
        return encoded ? linear_from_srgb(value) : value;
    }

    PlyHeader header_;
    PlyBody body_;
    PlyOptions options_;
    MeshFile file_;
    std::vector<double> row_;           // of the element that is being read
    std::vector<PlyAttribute> sources_; // of its attributes
};

} // namespace

MeshFile parse_ply(const std::filesystem::path& file, std::string_view content, const PlyOptions& options)
{
    const SourceLocation where{file.string(), 0};
    return PlyReader(where, without_byte_order_mark(content, where), options).read();
}

MeshFile load_ply(const std::filesystem::path& file, const SourceLocation& wanted_at, const PlyOptions& options)
{
    return parse_ply(file, read_text_file(file, wanted_at), options);
}

} // namespace sundog
