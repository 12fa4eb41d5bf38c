#include "render/bench_meshes.h"

#include <cmath>
#include <map>
#include <utility>

namespace sundog
{
namespace
{

uint add_vertex(TriangleMesh& mesh, Vec3 position)
{
    mesh.positions.push_back(position);
    return static_cast<uint>(mesh.positions.size() - 1);
}

float lattice_value(int x, int y)
{
    uint h = static_cast<uint>(x) * 0x9e3779b9u ^ static_cast<uint>(y) * 0x85ebca6bu;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return static_cast<float>((h ^ h >> 16) >> 8) * 0x1p-24f;
}

// Points on the unit sphere with an index each, and the midpoints made so far.
struct UnitSphere {
    std::vector<Vec3> points;
    std::map<std::pair<uint, uint>, uint> midpoints;

    uint midpoint(uint a, uint b)
    {
        const auto [entry, is_new] = midpoints.try_emplace(std::minmax(a, b), static_cast<uint>(points.size()));
        if (is_new) points.push_back(normalize(points[a] + points[b]));
        return entry->second;
    }
};

std::vector<std::array<uint, 3>> icosahedron(UnitSphere& sphere)
{
    // Three golden rectangles: vertex 4k + {0, 1, 2, 3} of the one across axis k.
    const float golden = 0.5f * (1.0f + std::sqrt(5.0f));
    for (int k = 0; k < 3; k++) {
        for (float a : {-1.0f, 1.0f}) {
            for (float b : {-golden, golden}) {
                float p[3];
                p[k] = 0.0f, p[(k + 1) % 3] = a, p[(k + 2) % 3] = b;
                sphere.points.push_back(normalize(Vec3{p[0], p[1], p[2]}));
            }
        }
    }
    // Faces are the triples of vertices at mutual distance of one edge.
    const float edge = length(sphere.points[0] - sphere.points[2]) * 1.01f;
    const auto near = [&](uint a, uint b) { return length(sphere.points[a] - sphere.points[b]) < edge; };
    std::vector<std::array<uint, 3>> faces;
    for (uint a = 0; a < 12; a++) {
        for (uint b = a + 1; b < 12; b++) {
            for (uint c = b + 1; c < 12; c++) {
                if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
                const Vec3 p = sphere.points[a], q = sphere.points[b], r = sphere.points[c];
                const bool outwards = dot(cross(q - p, r - p), p) > 0.0f;
                faces.push_back(outwards ? std::array{a, b, c} : std::array{a, c, b});
            }
        }
    }
    return faces;
}

} // namespace

void add_quad(TriangleMesh& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d)
{
    const uint i = add_vertex(mesh, a), j = add_vertex(mesh, b), k = add_vertex(mesh, c), l = add_vertex(mesh, d);
    mesh.triangles.push_back({i, j, k});
    mesh.triangles.push_back({i, k, l});
}

void add_box(TriangleMesh& mesh, Vec3 lower, Vec3 upper)
{
    const uint base = static_cast<uint>(mesh.positions.size());
    for (int i = 0; i < 8; i++) mesh.positions.push_back({i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
    const uint faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& face : faces) {
        mesh.triangles.push_back({base + face[0], base + face[1], base + face[2]});
        mesh.triangles.push_back({base + face[0], base + face[2], base + face[3]});
    }
}

void add_icosphere(TriangleMesh& mesh, Vec3 center, float radius, int subdivisions)
{
    UnitSphere sphere;
    std::vector<std::array<uint, 3>> faces = icosahedron(sphere);
    for (int level = 0; level < subdivisions; level++) {
        std::vector<std::array<uint, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const uint ab = sphere.midpoint(a, b), bc = sphere.midpoint(b, c), ca = sphere.midpoint(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    const uint base = static_cast<uint>(mesh.positions.size());
    for (Vec3 p : sphere.points) mesh.positions.push_back(center + radius * p);
    for (const auto& [a, b, c] : faces) mesh.triangles.push_back({base + a, base + b, base + c});
}

void add_terrain(TriangleMesh& mesh, int cells, float half_size, const std::function<float(float, float)>& height)
{
    const uint base = static_cast<uint>(mesh.positions.size());
    const uint row = static_cast<uint>(cells + 1);
    const auto coordinate = [&](int i) { return half_size * (2.0f * static_cast<float>(i) / static_cast<float>(cells) - 1.0f); };
    for (int j = 0; j <= cells; j++) {
        for (int i = 0; i <= cells; i++) mesh.positions.push_back({coordinate(i), height(coordinate(i), coordinate(j)), coordinate(j)});
    }
    for (int j = 0; j < cells; j++) {
        for (int i = 0; i < cells; i++) {
            const uint corner = base + static_cast<uint>(j) * row + static_cast<uint>(i);
            mesh.triangles.push_back({corner, corner + row, corner + row + 1});
            mesh.triangles.push_back({corner, corner + row + 1, corner + 1});
        }
    }
}

float value_noise(float x, float y)
{
    const float cell_x = std::floor(x), cell_y = std::floor(y);
    const int i = static_cast<int>(cell_x), j = static_cast<int>(cell_y);
    const auto smooth = [](float s) { return s * s * (3.0f - 2.0f * s); };
    const float s = smooth(x - cell_x), t = smooth(y - cell_y);
    return std::lerp(std::lerp(lattice_value(i, j), lattice_value(i + 1, j), s),
                     std::lerp(lattice_value(i, j + 1), lattice_value(i + 1, j + 1), s), t);
}

float fractal_noise(float x, float y, int octaves)
{
    float sum = 0.0f, weight = 0.5f;
    for (int octave = 0; octave < octaves; octave++, weight *= 0.5f, x *= 2.0f, y *= 2.0f) sum += weight * value_noise(x, y);
    return sum;
}

} // namespace sundog
