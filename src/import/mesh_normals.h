// Normals that a mesh file does not give.
#pragma once

#include "scene/scene.h"

namespace sundog
{

// Fills in normals that are missing or of no length: the normals of the triangles around a vertex, weighted by their
// angle there [Thuermer and Wuethrich 1998]. Makes all unit length. No triangle may be degenerate.
void complete_normals(TriangleMesh& mesh);

// Smooth where neighbouring triangles meet at up to `max_angle` (rad) between their normals, with creases elsewhere: as
// in Mitsuba 0.6, the corners at one place (position, texture coordinates and attributes equal) share a vertex if their
// triangles' normals are that close to the first's of them. Replaces all normals. No triangle may be degenerate.
void smooth_up_to(TriangleMesh& mesh, double max_angle);

} // namespace sundog
