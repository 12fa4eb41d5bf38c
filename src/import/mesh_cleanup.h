// What every mesh goes through after it is read: transformed, checked, freed of degenerate triangles.
#pragma once

#include "base/errors.h"
#include "math/transform.h"
#include "scene/scene.h"

namespace sundog
{

// Moves positions and normals. The side that normals and windings name as outside stays outside, also under a
// reflection, unless `flip` turns the surface inside out.
void transform_mesh(TriangleMesh& mesh, const Transform& to_world, bool flip);

// Throws SceneError naming the first vertex with an infinite or NaN coordinate, of position, normal or texture, that a
// triangle uses. `file`: as the message names it; empty where `where` does. What no triangle uses becomes 0 where it is not finite.
// Vertices count from 1, as in OBJ.
void require_finite_vertices(TriangleMesh& mesh, const SourceLocation& where, const std::string& file);

// Throws SceneError naming the first triangle with a vertex index out of range.
void require_valid_indices(const TriangleMesh& mesh, const SourceLocation& where, const std::string& file);

// Removes triangles without area, keeping face attributes and `of_triangle` (empty, or one entry a triangle) in step;
// returns how many.
std::size_t drop_degenerate_triangles(TriangleMesh& mesh, std::vector<int>& of_triangle);

} // namespace sundog
