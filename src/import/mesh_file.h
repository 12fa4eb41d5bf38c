// What a reader of mesh files returns.
#pragma once

#include "base/warning.h"
#include "scene/scene.h"

namespace sundog
{

struct MeshFile {
    TriangleMesh mesh;                 // as in the file: untransformed, normals not normalized ({0, 0, 0} where the file gives none)
    bool face_normals = false;         // the file asks for flat shading
    std::vector<Warning> warnings;     // without file and line
};

} // namespace sundog
