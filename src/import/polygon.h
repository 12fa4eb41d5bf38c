// Polygons of mesh files as triangles.
#pragma once

#include "math/vec3.h"

#include <array>
#include <span>
#include <vector>

namespace sundog
{

// Appends the triangles of a polygon of at least three vertices, which are indices into `positions`. Convex ones become
// a fan around their first vertex, as in Mitsuba; others are clipped ear by ear in the plane that fits them best.
// False, with nothing appended, for a concave polygon of more than max_concave_corners: ear clipping takes cubic time.
bool append_polygon(const std::vector<Vec3>& positions, std::span<const uint> polygon, std::vector<std::array<uint, 3>>& triangles);

constexpr std::size_t max_concave_corners = 512;

} // namespace sundog
