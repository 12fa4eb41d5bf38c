// Meshes made by formula, for benchmarks and tests.
#pragma once

#include "scene/scene.h"

#include <functional>

namespace sundog
{

// Appends a planar quadrilateral a b c d as two triangles.
void add_quad(TriangleMesh& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d);

// Appends an axis-aligned box of 12 triangles that share its 8 vertices, normals outwards.
void add_box(TriangleMesh& mesh, Vec3 lower, Vec3 upper);

// Appends an icosahedron whose faces are split in four `subdivisions` times and pushed out to the sphere:
// 20 * 4^subdivisions triangles. The mesh is closed: neighbours share their vertices.
void add_icosphere(TriangleMesh& mesh, Vec3 center, float radius, int subdivisions);

// Appends a grid of cells x cells squares over [-half_size, half_size]^2 in x and z, at y = height(x, z).
void add_terrain(TriangleMesh& mesh, int cells, float half_size, const std::function<float(float, float)>& height);

// Value noise in [0, 1], smooth between the integers, and sums of it in octaves of halving size.
float value_noise(float x, float y);
float fractal_noise(float x, float y, int octaves);

} // namespace sundog
