// Wavefront OBJ meshes; their material libraries through tinyobjloader.
#pragma once

#include "base/errors.h"
#include "import/mesh_file.h"

#include <filesystem>
#include <optional>

namespace sundog
{

struct ObjMaterial {
    std::string name;
    Vec3 diffuse;
    std::optional<std::filesystem::path> diffuse_image; // map_Kd, which takes the place of `diffuse`, as in Mitsuba 0.6
    bool image_repeats = true; // else its edge goes on
};

struct ObjOptions {
    bool with_materials = false;
    bool flip_tex_coords = true; // v becomes 1 - v: images count their rows from above
    // Only this one of the file's shapes, counted from 0: as in Mitsuba 0.6, g and usemtl begin a new shape where the
    // last one has faces.
    std::optional<int> shape_index;
};

struct ObjFile : MeshFile {
    std::vector<int> material_of_triangle; // index into materials, or -1; empty without materials
    std::vector<ObjMaterial> materials;
    std::size_t shapes = 0; // in the file
};

// Polygons are triangulated. Vertices are distinct triples of position, texture coordinate and normal, as in Mitsuba, so
// that seams stay sharp where normals have to be computed; a corner without a texture coordinate has (0, 0). Materials
// (diffuse colours and images) are read on request only. Lines that end in a backslash continue.
// Throws SceneError: at `wanted_at` for an unreadable file, else at the line of the OBJ file for coordinates that are not
// finite numbers, faces of fewer than three vertices, concave faces of very many, and indices that are zero, malformed or
// out of range.
ObjFile load_obj(const std::filesystem::path& file, const SourceLocation& wanted_at, const ObjOptions& options);

// The same for the content of a file named `file` in messages; material libraries are looked for beside it.
ObjFile parse_obj(const std::filesystem::path& file, std::string_view content, const ObjOptions& options);

} // namespace sundog
