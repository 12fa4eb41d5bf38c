// What a reader of mesh files returns.
#pragma once

#include "base/warning.h"
#include "scene/scene.h"

namespace sundog
{

struct MeshFile {
    // As in the file: positions less an origin that was asked for, in double precision, but untransformed; normals not normalized ({0, 0,
    // 0} where the file gives none), perhaps not finite.
    TriangleMesh mesh;
    bool face_normals = false;         // the file asks for flat shading
    bool single_precision = false;     // the file has positions as 32-bit numbers
    std::vector<Warning> warnings;     // without file and line
};

// How warnings go on after a count of faces.
constexpr const char* few_corners_dropped = " of fewer than three vertices dropped";

} // namespace sundog
