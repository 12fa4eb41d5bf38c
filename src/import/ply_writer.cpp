#include "import/ply_writer.h"

#include <bit>

namespace sundog
{

namespace
{

template <class T> void put(std::string& bytes, T value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put(std::string& bytes, Vec3 v)
{
    for (float c : {v.x, v.y, v.z}) put(bytes, c);
}

void declare(std::string& header, std::initializer_list<std::string> names)
{
    for (const std::string& name : names) header += "property float " + name + "\n";
}

// Names that ply_attributes.h joins to the attribute's own.
void declare_attributes(std::string& header, const TriangleMesh& mesh, bool per_face)
{
    const std::size_t prefix = std::string_view(per_face ? "face_" : "vertex_").size();
    for (const auto& attribute : mesh.attributes) {
        if (attribute.per_face != per_face) continue;
        const std::string name = attribute.name.substr(prefix);
        if (name == "color")
            declare(header, {"r", "g", "b"});
        else
            declare(header, {name + "_0", name + "_1", name + "_2"});
    }
}

void put_attributes(std::string& bytes, const TriangleMesh& mesh, bool per_face, std::size_t i)
{
    for (const auto& attribute : mesh.attributes)
        if (attribute.per_face == per_face) put(bytes, attribute.values[i]);
}

std::string header_of(const TriangleMesh& mesh)
{
    std::string header = "ply\nformat ";
    header += std::endian::native == std::endian::little ? "binary_little_endian" : "binary_big_endian";
    header += " 1.0\nelement vertex " + std::to_string(mesh.positions.size()) + "\n";
    declare(header, {"x", "y", "z"});
    if (!mesh.normals.empty()) declare(header, {"nx", "ny", "nz"});
    if (!mesh.uvs.empty()) declare(header, {"u", "v"});
    declare_attributes(header, mesh, false);
    header += "element face " + std::to_string(mesh.triangles.size()) + "\nproperty list uchar uint vertex_indices\n";
    declare_attributes(header, mesh, true);
    return header + "end_header\n";
}

} // namespace

std::string ply_bytes(const TriangleMesh& mesh)
{
    std::string bytes = header_of(mesh);
    bytes.reserve(bytes.size() + mesh.positions.size() * 8 * sizeof(float) + mesh.triangles.size() * (1 + 3 * sizeof(uint)));
    for (std::size_t i = 0; i < mesh.positions.size(); i++) {
        put(bytes, mesh.positions[i]);
        if (!mesh.normals.empty()) put(bytes, mesh.normals[i]);
        if (!mesh.uvs.empty()) {
            put(bytes, mesh.uvs[i].x);
            put(bytes, mesh.uvs[i].y);
        }
        put_attributes(bytes, mesh, false, i);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); i++) {
        put(bytes, static_cast<unsigned char>(3));
        for (uint v : mesh.triangles[i]) put(bytes, v);
        put_attributes(bytes, mesh, true, i);
    }
    return bytes;
}

} // namespace sundog
