// PLY meshes, ASCII and binary of either byte order.
#pragma once

#include "base/errors.h"
#include "import/mesh_file.h"

#include <filesystem>

namespace sundog
{

// How colours become linear sRGB. Integers are scaled to [0, 1] first in each case.
enum class PlyColors {
    by_type, // integers are sRGB-encoded, floats linear: Mitsuba 3
    encoded, // all are sRGB-encoded: Mitsuba 0.6 unless srgb is false
    linear,
};

struct PlyOptions {
    bool flip_tex_coords = false; // v becomes 1 - v
    PlyColors colors = PlyColors::by_type;
    Double3 origin{0, 0, 0}; // is subtracted from positions, in double precision
};

// The triangles of the file (polygons triangulated) and its vertices in their order: positions x y z; normals nx ny nz;
// texture coordinates u v, s t or texture_u texture_v; other properties as attributes, named as in ply_attributes.h.
// Vertices and faces may come in any order, with any properties, scalars or lists. What is not used is named in the
// warnings. No more memory is taken than a small multiple of the file's size, whatever its header promises.
// Throws SceneError: at `wanted_at` for an unreadable file, at the PLY file (and the line, within the header and in text
// files) for a malformed header, missing vertices or faces, data that ends early, values that are not numbers, concave
// faces of very many vertices, and indices out of range. Faces of fewer than three vertices are dropped, with their count
// among the warnings. Values that are not finite are left for whoever uses them.
MeshFile load_ply(const std::filesystem::path& file, const SourceLocation& wanted_at, const PlyOptions& options);

// The same for the content of a file named `file` in messages.
MeshFile parse_ply(const std::filesystem::path& file, std::string_view content, const PlyOptions& options);

} // namespace sundog
