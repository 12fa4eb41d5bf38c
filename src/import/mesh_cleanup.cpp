#include "import/mesh_cleanup.h"

#include <cmath>

namespace sundog
{

namespace
{

Double3 difference(Vec3 a, Vec3 b)
{
    return {static_cast<double>(a.x) - b.x, static_cast<double>(a.y) - b.y, static_cast<double>(a.z) - b.z};
}

Double3 cross(const Double3& a, const Double3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Double3& a, const Double3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
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
    for (auto& p : mesh.positions) p = to_world.point(p);
    for (auto& n : mesh.normals) {
        if (n == Vec3{0, 0, 0}) continue;
        n = to_world.normal(n);
        if (flip) n = -n;
    }
    if ((to_world.determinant() < 0.0) != flip)
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

void require_finite_vertices(const TriangleMesh& mesh, const SourceLocation& where, const std::string& file)
{
    for (std::size_t i = 0; i < mesh.positions.size(); i++)
        if (!is_finite(mesh.positions[i]))
            throw SceneError(where, "vertex " + std::to_string(i + 1) + " of " + file + " is not finite: repair the mesh or its transform");
    for (std::size_t i = 0; i < mesh.normals.size(); i++)
        if (!is_finite(mesh.normals[i]))
            throw SceneError(where, "the normal of vertex " + std::to_string(i + 1) + " of " + file + " is not finite: repair the mesh");
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
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i++) {
        if (is_degenerate(mesh, mesh.triangles[i])) continue;
        mesh.triangles[kept] = mesh.triangles[i];
        if (!of_triangle.empty()) of_triangle[kept] = of_triangle[i];
        kept++;
    }
    const std::size_t dropped = mesh.triangles.size() - kept;
    mesh.triangles.resize(kept);
    if (!of_triangle.empty()) of_triangle.resize(kept);
    return dropped;
}

void complete_normals(TriangleMesh& mesh)
{
    mesh.normals.resize(mesh.positions.size(), Vec3{0, 0, 0});
    std::vector<Double3> sums(mesh.positions.size(), Double3{0, 0, 0});
    std::vector<Double3> any(mesh.positions.size(), Double3{0, 0, 0});
    for (const auto& t : mesh.triangles) {
        Double3 n = cross(difference(mesh.positions[t[1]], mesh.positions[t[0]]), difference(mesh.positions[t[2]], mesh.positions[t[0]]));
        const double length = std::sqrt(dot(n, n));
        for (double& c : n) c /= length;
        for (std::size_t k = 0; k < 3; k++) {
            const uint v = t[k];
            const Double3 a = difference(mesh.positions[t[(k + 1) % 3]], mesh.positions[v]);
            const Double3 b = difference(mesh.positions[t[(k + 2) % 3]], mesh.positions[v]);
            const Double3 c = cross(a, b);
            const double angle = std::atan2(std::sqrt(dot(c, c)), dot(a, b));
            for (std::size_t i = 0; i < 3; i++) sums[v][i] += angle * n[i];
            any[v] = n;
        }
    }
    for (std::size_t i = 0; i < mesh.normals.size(); i++) {
        Vec3& normal = mesh.normals[i];
        Double3 n{normal.x, normal.y, normal.z};
        if (!(dot(n, n) > 0.0)) n = sums[i];
        if (!(dot(n, n) > 1e-12)) n = any[i]; // opposite faces that cancel out
        double length = std::sqrt(dot(n, n));
        if (!(length > 0.0)) {
            n = {0, 0, 1}; // no triangle uses the vertex
            length = 1.0;
        }
        normal = {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length), static_cast<float>(n[2] / length)};
    }
}

} // namespace sundog
