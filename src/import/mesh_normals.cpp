#include "import/mesh_normals.h"

#include "import/mesh_parts.h"
#include "math/double3.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sundog
{

namespace
{

struct SumAtVertex {
    Double3 sum{0, 0, 0}; // of the normals around, weighted
    Double3 any{0, 0, 0}; // one of them
};

Double3 triangle_normal(const TriangleMesh& mesh, const std::array<uint, 3>& t)
{
    Double3 n = cross(difference(mesh.positions[t[1]], mesh.positions[t[0]]), difference(mesh.positions[t[2]], mesh.positions[t[0]]));
    const double length = std::sqrt(dot(n, n));
    for (double& c : n) c /= length;
    return n;
}

bool is_opposed(const TriangleMesh& mesh, const std::array<uint, 3>& t)
{
    const Double3 n = triangle_normal(mesh, t);
    int opposed = 0, given = 0;
    for (const uint v : t) {
        const Vec3 normal = mesh.normals[v];
        const Double3 at{normal.x, normal.y, normal.z};
        const double length = std::sqrt(dot(at, at));
        constexpr double rounding = 1e-5; // of a cosine: of a normal along the face
        if (length > 0.0) given++;
        if (dot(n, at) < -rounding * length) opposed++;
    }
    return 2 * opposed > given;
}

void add_normals(const TriangleMesh& mesh, std::vector<SumAtVertex>& at)
{
    for (const auto& t : mesh.triangles) {
        const Double3 n = triangle_normal(mesh, t);
        for (std::size_t k = 0; k < 3; k++) {
            const uint v = t[k];
            const Double3 a = difference(mesh.positions[t[(k + 1) % 3]], mesh.positions[v]);
            const Double3 b = difference(mesh.positions[t[(k + 2) % 3]], mesh.positions[v]);
            const Double3 c = cross(a, b);
            const double angle = std::atan2(std::sqrt(dot(c, c)), dot(a, b));
            for (std::size_t i = 0; i < 3; i++) at[v].sum[i] += angle * n[i];
            at[v].any = n;
        }
    }
}

bool has_length(Vec3 v)
{
    return dot(v, v) > 0.0f;
}

// A triangle's corner: which vertex it was, and what it looks like but for the normal.
struct CornerOrder {
    const TriangleMesh& mesh;

    // Negative, zero or positive. -0 and 0 are equal, and nothing is NaN.
    static int compare(float a, float b) { return a < b ? -1 : a > b ? 1 : 0; }
    static int compare(Vec3 a, Vec3 b)
    {
        if (const int x = compare(a.x, b.x)) return x;
        if (const int y = compare(a.y, b.y)) return y;
        return compare(a.z, b.z);
    }

    int operator()(uint a, uint b) const
    {
        if (a == b) return 0;
        if (const int p = compare(mesh.positions[a], mesh.positions[b])) return p;
        if (!mesh.uvs.empty()) {
            if (const int u = compare(mesh.uvs[a].x, mesh.uvs[b].x)) return u;
            if (const int v = compare(mesh.uvs[a].y, mesh.uvs[b].y)) return v;
        }
        for (const auto& attribute : mesh.attributes)
            if (!attribute.per_face)
                if (const int c = compare(attribute.values[a], attribute.values[b])) return c;
        return 0;
    }
};

} // namespace

bool has_opposed_faces(const TriangleMesh& mesh)
{
    return !mesh.normals.empty() &&
           std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) { return is_opposed(mesh, t); });
}

std::size_t turn_opposed_faces(TriangleMesh& mesh)
{
    if (mesh.normals.empty()) return 0;
    std::size_t turned = 0;
    for (auto& t : mesh.triangles) {
        if (!is_opposed(mesh, t)) continue;
        std::swap(t[1], t[2]);
        turned++;
    }
    return turned;
}

void complete_normals(TriangleMesh& mesh)
{
    mesh.normals.resize(mesh.positions.size(), Vec3{0, 0, 0});
    std::vector<SumAtVertex> around;
    if (!std::all_of(mesh.normals.begin(), mesh.normals.end(), has_length)) {
        around.resize(mesh.positions.size());
        add_normals(mesh, around);
    }
    for (std::size_t i = 0; i < mesh.normals.size(); i++) {
        Vec3& normal = mesh.normals[i];
        Double3 n{normal.x, normal.y, normal.z};
        if (!around.empty() && !(dot(n, n) > 0.0)) {
            n = around[i].sum;
            if (!(dot(n, n) > 1e-12)) n = around[i].any; // opposite faces that cancel out
        }
        const double squared = dot(n, n);
        constexpr double rounding = 1e-6; // as in direction_and_length(), whose contract holds here too
        if (std::abs(squared - 1.0) <= rounding)
            normal = {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])};
        else if (const double length = std::sqrt(squared); length > 0.0)
            normal = {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length), static_cast<float>(n[2] / length)};
        else
            normal = {0, 0, 1}; // no triangle uses the vertex
    }
}

void smooth_up_to(TriangleMesh& mesh, double max_angle)
{
    const CornerOrder order{mesh};
    const auto vertex_of = [&](uint corner) -> uint { return mesh.triangles[corner / 3][corner % 3]; };
    std::vector<uint> corners(3 * mesh.triangles.size());
    std::iota(corners.begin(), corners.end(), 0u);
    std::sort(corners.begin(), corners.end(), [&](uint a, uint b) {
        const int difference = order(vertex_of(a), vertex_of(b));
        return difference != 0 ? difference < 0 : a < b;
    });

    std::vector<Double3> normals;
    for (const auto& t : mesh.triangles) normals.push_back(triangle_normal(mesh, t));
    const double least_cosine = std::cos(max_angle);
    const auto close = [&](uint a, uint b) { return a / 3 == b / 3 || dot(normals[a / 3], normals[b / 3]) >= least_cosine; };

    std::vector<uint> sources;
    std::vector<std::array<uint, 3>> triangles(mesh.triangles.size());
    for (std::size_t begin = 0, end; begin < corners.size(); begin = end) {
        end = begin + 1;
        while (end < corners.size() && order(vertex_of(corners[begin]), vertex_of(corners[end])) == 0) end++;
        // Each round takes the corners close to the first that is left.
        std::size_t left = begin;
        while (left < end) {
            const uint first = corners[left];
            const auto rest =
                std::stable_partition(corners.begin() + static_cast<std::ptrdiff_t>(left),
                                      corners.begin() + static_cast<std::ptrdiff_t>(end), [&](uint c) { return close(first, c); });
            for (; corners.begin() + static_cast<std::ptrdiff_t>(left) != rest; left++)
                triangles[corners[left] / 3][corners[left] % 3] = static_cast<uint>(sources.size());
            sources.push_back(vertex_of(first));
        }
    }
    mesh.normals.clear();
    copy_vertices(mesh, sources);
    mesh.triangles = std::move(triangles);
    complete_normals(mesh);
}

} // namespace sundog
