// PLY meshes, ASCII and binary.
#pragma once

#include "base/errors.h"
#include "scene/scene.h"

#include <filesystem>

namespace sundog
{

// The triangles of the file (polygons triangulated), its vertices in their order, and its vertex normals if any.
// Throws SceneError: at `wanted_at` for an unreadable file, at the PLY file for a malformed one (as check_ply
// has it); in a minimal build, always.
TriangleMesh load_ply(const std::filesystem::path& file, const SourceLocation& wanted_at);

} // namespace sundog
