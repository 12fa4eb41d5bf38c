#include "import/mesh_parts.h"

namespace sundog
{

namespace
{

template <class T> std::vector<T> gathered(const std::vector<T>& from, const std::vector<uint>& indices)
{
    std::vector<T> result;
    if (from.empty()) return result;
    result.reserve(indices.size());
    for (uint i : indices) result.push_back(from[i]);
    return result;
}

constexpr uint unused = 0xffffffffu;

} // namespace

void copy_vertices(TriangleMesh& mesh, const std::vector<uint>& sources)
{
    mesh.positions = gathered(mesh.positions, sources);
    mesh.normals = gathered(mesh.normals, sources);
    mesh.uvs = gathered(mesh.uvs, sources);
    for (auto& attribute : mesh.attributes)
        if (!attribute.per_face) attribute.values = gathered(attribute.values, sources);
}

void keep_triangles(TriangleMesh& mesh, const std::vector<uint>& kept)
{
    mesh.triangles = gathered(mesh.triangles, kept);
    for (auto& attribute : mesh.attributes)
        if (attribute.per_face) attribute.values = gathered(attribute.values, kept);
}

TriangleMesh extract_triangles(const TriangleMesh& mesh, const std::vector<uint>& wanted)
{
    TriangleMesh part = mesh;
    keep_triangles(part, wanted);
    std::vector<uint> number_of(mesh.positions.size(), unused), sources;
    for (auto& triangle : part.triangles)
        for (uint& vertex : triangle) {
            uint& number = number_of[vertex];
            if (number == unused) {
                number = static_cast<uint>(sources.size());
                sources.push_back(vertex);
            }
            vertex = number;
        }
    copy_vertices(part, sources);
    return part;
}

} // namespace sundog
