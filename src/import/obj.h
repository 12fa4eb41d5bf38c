// Wavefront OBJ meshes, through tinyobjloader.
#pragma once

#include "base/errors.h"
#include "scene/scene.h"

#include <filesystem>

namespace sundog
{

struct ObjMaterial {
    std::string name;
    Vec3 diffuse;
};

struct ObjFile {
    TriangleMesh mesh; // polygons triangulated; normals empty, or one a position with {0, 0, 0} where the file gives none
    std::vector<int> material_of_triangle; // index into materials, or -1; empty without materials
    std::vector<ObjMaterial> materials;
    std::vector<std::string> warnings; // of the material library, without file and line
};

// Vertices are distinct triples of position, texture coordinate and normal, as in Mitsuba, so that seams stay sharp
// where normals have to be computed. Materials (diffuse colours) are read on request only.
// Throws SceneError: at `wanted_at` for an unreadable file, else at the line of the OBJ file for coordinates that are
// not finite numbers, faces of fewer than three vertices, and indices that are zero, malformed or out of range.
ObjFile load_obj(const std::filesystem::path& file, const SourceLocation& wanted_at, bool with_materials);

} // namespace sundog
