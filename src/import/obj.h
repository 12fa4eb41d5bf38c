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
    bool with_normals = true;    // else the file's are not looked at
    bool flip_tex_coords = true; // v becomes 1 - v: images count their rows from above
    Double3 origin{0, 0, 0};     // is subtracted from positions, in double precision
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
// (diffuse colours and images) are read on request only. Lines that end in a backslash continue; # begins a comment. A
// corner can leave the places of its texture coordinate and normal empty or 0. Faces of fewer than three vertices are
// dropped, with their count among the warnings.
// Throws SceneError: at `wanted_at` for an unreadable file, else at the line of the OBJ file for values that are not
// numbers, values not finite that a face uses, concave faces of very many vertices, and indices that are malformed or out
// of range.
ObjFile load_obj(const std::filesystem::path& file, const SourceLocation& wanted_at, const ObjOptions& options);

// The same for the content of a file named `file` in messages; material libraries are looked for beside it.
ObjFile parse_obj(const std::filesystem::path& file, std::string_view content, const ObjOptions& options);

} // namespace sundog
