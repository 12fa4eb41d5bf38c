// Mesh shapes of a scene file.
#pragma once

#include "import/obj.h"
#include "import/object_reader.h"

namespace sundog
{

// A mesh shape, ready to use: in world space, finite, without degenerate triangles. The materials are those of an OBJ
// file, empty unless asked for. Each throws SceneError for unreadable, broken and empty meshes.
ObjFile import_obj(ObjectReader& reader, bool with_materials);
TriangleMesh import_ply(ObjectReader& reader);
TriangleMesh import_serialized(ObjectReader& reader);
// [-1, 1]^2 in the plane z = 0, normal +z; texture coordinates ((x + 1) / 2, (y + 1) / 2).
TriangleMesh import_rectangle(ObjectReader& reader);
// [-1, 1]^3, normals outwards; texture coordinates in [0, 1]^2 on each face.
TriangleMesh import_cube(ObjectReader& reader);

} // namespace sundog
