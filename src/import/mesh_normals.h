// Normals that a mesh file does not give.
#pragma once

#include "scene/scene.h"

namespace sundog
{

// Turns round the triangles that are opposed: most normals of their vertices, those of no length apart, point to the other
// side than the winding says. Exporters write such meshes, and other renderers take the side from the normals. Returns how
// many. No triangle may be degenerate.
std::size_t turn_opposed_faces(TriangleMesh& mesh);
bool has_opposed_faces(const TriangleMesh& mesh);

// Fills in normals that are missing or of no length: the normals of the triangles around a vertex, weighted by their
// angle there [Thuermer and Wuethrich 1998]. Makes all unit length. No triangle may be degenerate.
void complete_normals(TriangleMesh& mesh);

// Smooth where neighbouring triangles meet at up to `max_angle` (rad) between their normals, with creases elsewhere: as
// in Mitsuba 0.6, the corners at one place (position, texture coordinates and attributes equal) share a vertex if their
// triangles' normals are that close to the first's of them. Replaces all normals. No triangle may be degenerate.
void smooth_up_to(TriangleMesh& mesh, double max_angle);

} // namespace sundog
