#include "import/mesh_import.h"

#include "import/mesh_cleanup.h"
#include "import/ply.h"

namespace sundog
{

namespace
{

// Everything between a file's triangles and a shape's. `file`: as messages name it.
void finish_mesh(ObjectReader& reader, TriangleMesh& mesh, std::vector<int>& of_triangle, const std::string& file)
{
    require_valid_indices(mesh, reader.where(), file);
    require_finite_vertices(mesh, reader.where(), file);
    const Transform to_world = reader.transform("to_world");
    transform_mesh(mesh, to_world, reader.boolean("flip_normals", false));
    require_finite_vertices(mesh, reader.where_of("to_world"), file);
    const std::size_t dropped = drop_degenerate_triangles(mesh, of_triangle);
    if (dropped > 0)
        reader.index().warn(reader.where(),
                            std::to_string(dropped) + " degenerate triangle" + (dropped == 1 ? "" : "s") + " of " + file + " dropped");
    if (mesh.triangles.empty()) throw SceneError(reader.where(), file + " has no triangles" + (dropped > 0 ? " but degenerate ones" : ""));
}

void finish_file_mesh(ObjectReader& reader, TriangleMesh& mesh, std::vector<int>& of_triangle, const std::string& file)
{
    finish_mesh(reader, mesh, of_triangle, file);
    // Without normals in the file Mitsuba computes smooth ones.
    if (reader.boolean("face_normals", false))
        mesh.normals.clear();
    else
        complete_normals(mesh);
    for (const char* name : {"flip_tex_coords", "collapse", "srgb", "load_materials"})
        reader.ignore(name, "it does not change the geometry");
    reader.refuse("max_smooth_angle", "compute the normals in a modeller, or set face_normals");
    reader.refuse("shape_index", "split the file");
}

TriangleMesh finish_generated(ObjectReader& reader, TriangleMesh mesh, const std::string& name)
{
    std::vector<int> none;
    finish_mesh(reader, mesh, none, name);
    return mesh;
}

} // namespace

ObjFile import_obj(ObjectReader& reader, bool with_materials)
{
    const std::string filename = reader.text("filename", "");
    const auto path = reader.index().find_file(filename, reader.where_of("filename"));
    ObjFile obj = load_obj(path, reader.where_of("filename"), with_materials);
    for (const auto& warning : obj.warnings) reader.index().warn({path.string(), 0}, warning);
    finish_file_mesh(reader, obj.mesh, obj.material_of_triangle, path.string());
    return obj;
}

TriangleMesh import_ply(ObjectReader& reader)
{
    const std::string filename = reader.text("filename", "");
    const auto path = reader.index().find_file(filename, reader.where_of("filename"));
    TriangleMesh mesh = load_ply(path, reader.where_of("filename"));
    std::vector<int> none;
    finish_file_mesh(reader, mesh, none, path.string());
    return mesh;
}

TriangleMesh import_rectangle(ObjectReader& reader)
{
    TriangleMesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return finish_generated(reader, std::move(mesh), "the rectangle");
}

TriangleMesh import_cube(ObjectReader& reader)
{
    TriangleMesh mesh;
    // Vertex i has x, y, z = +1 where bits 0, 1, 2 of i are set.
    for (int i = 0; i < 8; i++)
        mesh.positions.push_back({(i & 1) != 0 ? 1.0f : -1.0f, (i & 2) != 0 ? 1.0f : -1.0f, (i & 4) != 0 ? 1.0f : -1.0f});
    mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return finish_generated(reader, std::move(mesh), "the cube");
}

} // namespace sundog
