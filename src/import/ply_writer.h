// Meshes as binary PLY.
#pragma once

#include "scene/scene.h"

namespace sundog
{

// The bytes of a file that load_ply() reads as the same mesh, bit for bit. Attributes must be named as ply_attributes.h
// says.
std::string ply_bytes(const TriangleMesh& mesh);

} // namespace sundog
