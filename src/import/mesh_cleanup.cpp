#include "import/mesh_cleanup.h"

#include "import/mesh_parts.h"
#include "math/double3.h"

#include <algorithm>
#include <cmath>

namespace sundog
{

namespace
{

bool is_finite(Vec2 v)
{
    return std::isfinite(v.x) && std::isfinite(v.y);
}

// Whether the height over the longest edge is lost in the rounding of double precision. Thin triangles of
// float vertices stay.
bool is_degenerate(const TriangleMesh& mesh, const std::array<uint, 3>& t)
{
    const Double3 a = difference(mesh.positions[t[1]], mesh.positions[t[0]]);
    const Double3 b = difference(mesh.positions[t[2]], mesh.positions[t[0]]);
    const Double3 c = difference(mesh.positions[t[2]], mesh.positions[t[1]]);
    const Double3 n = cross(a, b);
    const double longest = std::max({dot(a, a), dot(b, b), dot(c, c)});
    return !(dot(n, n) > 1e-26 * longest * longest);
}

} // namespace

void transform_mesh(TriangleMesh& mesh, const Transform& to_world, bool flip)
{
    if (to_world.is_identity() && !flip) return; // which arithmetic would round
    for (auto& p : mesh.positions) p = to_world.point(p);
    for (auto& n : mesh.normals) {
        if (n == Vec3{0, 0, 0}) continue;
        n = to_world.normal(n);
        if (flip) n = -n;
    }
    if ((to_world.determinant() < 0.0) != flip)
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

void require_finite_vertices(TriangleMesh& mesh, const SourceLocation& where, const std::string& file)
{
    std::vector<bool> used(mesh.positions.size());
    for (const auto& triangle : mesh.triangles)
        for (uint v : triangle) used[v] = true;
    const auto check = [&](auto& values, const char* what, const char* cure) {
        for (std::size_t i = 0; i < values.size(); i++) {
            if (is_finite(values[i])) continue;
            if (used[i])
                throw SceneError(where, what + std::to_string(i + 1) + (file.empty() ? "" : " of " + file) +
                                            " is not finite: repair the mesh" + cure);
            values[i] = {};
        }
    };
    check(mesh.positions, "vertex ", " or its transform");
    check(mesh.normals, "the normal of vertex ", "");
    check(mesh.uvs, "the texture coordinate of vertex ", "");
}

void require_valid_indices(const TriangleMesh& mesh, const SourceLocation& where, const std::string& file)
{
    for (std::size_t i = 0; i < mesh.triangles.size(); i++)
        for (uint v : mesh.triangles[i])
            if (v >= mesh.positions.size())
                throw SceneError(where, "face " + std::to_string(i + 1) + " of " + file + " refers to vertex " + std::to_string(v + 1) +
                                            ", but there are " + std::to_string(mesh.positions.size()));
}

std::size_t drop_degenerate_triangles(TriangleMesh& mesh, std::vector<int>& of_triangle)
{
    std::vector<uint> kept;
    kept.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); i++)
        if (!is_degenerate(mesh, mesh.triangles[i])) kept.push_back(static_cast<uint>(i));
    const std::size_t dropped = mesh.triangles.size() - kept.size();
    if (dropped == 0) return 0;
    keep_triangles(mesh, kept);
    if (!of_triangle.empty())
        for (std::size_t i = 0; i < kept.size(); i++) of_triangle[i] = of_triangle[kept[i]];
    of_triangle.resize(std::min(of_triangle.size(), kept.size()));
    return dropped;
}

} // namespace sundog
