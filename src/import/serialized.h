// Mitsuba's own mesh files (.serialized), versions 3 and 4.
#pragma once

#include "base/errors.h"
#include "import/mesh_file.h"

#include <filesystem>

namespace sundog
{

// The mesh number `shape_index` (from 0) of the file: positions, and normals, texture coordinates and colours (linear
// sRGB, as the attribute vertex_color) if it has them. The format: uint16 0x041c, uint16 version, then deflated: uint32
// flags, the name (version 4, zero-terminated), uint64 counts of vertices and triangles, and the arrays in floats or
// doubles; at the end of the file the offsets of all meshes (uint64 in version 4, uint32 in 3) and their uint32 count.
// All little-endian. `origin` is subtracted from positions, in double precision. No more memory is taken than the data that is there needs,
// whatever the counts promise. Throws SceneError: at `wanted_at` for an unreadable file or a shape_index out of range, else at the file for
// one that is not such a file, ends early or is damaged, which the checksum at the end of the deflated data tells. Values may be not
// finite, and vertex indices out of range.
MeshFile load_serialized(const std::filesystem::path& file, const SourceLocation& wanted_at, int shape_index, const Double3& origin);

// The same for the content of a file named `file` in messages.
MeshFile parse_serialized(const std::filesystem::path& file, std::string_view content, const SourceLocation& wanted_at, int shape_index,
                          const Double3& origin);

} // namespace sundog
