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
TriangleMesh import_rectangle(ObjectReader& reader); // [-1, 1]^2 in the plane z = 0, normal +z
TriangleMesh import_cube(ObjectReader& reader);      // [-1, 1]^3, normals outwards

} // namespace sundog
