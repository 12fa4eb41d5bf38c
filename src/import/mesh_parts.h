// Parts of meshes, with everything that belongs to their vertices and triangles.
#pragma once

#include "scene/scene.h"

namespace sundog
{

// The mesh's vertices anew: vertex i is a copy of what was vertex sources[i]. The triangles are left for the caller to
// renumber.
void copy_vertices(TriangleMesh& mesh, const std::vector<uint>& sources);

// Keeps these triangles, in this order, and all vertices.
void keep_triangles(TriangleMesh& mesh, const std::vector<uint>& kept);

// These triangles with the vertices that they use.
TriangleMesh extract_triangles(const TriangleMesh& mesh, const std::vector<uint>& wanted);

} // namespace sundog
