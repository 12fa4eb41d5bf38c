// What a reader of mesh files returns.
#pragma once

#include "scene/scene.h"

namespace sundog
{

struct MeshFile {
    TriangleMesh mesh;                 // as in the file: untransformed, normals not normalized ({0, 0, 0} where the file gives none)
    bool face_normals = false;         // the file asks for flat shading
    std::vector<std::string> warnings; // without file and line
};

} // namespace sundog
