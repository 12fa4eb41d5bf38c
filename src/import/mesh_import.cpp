#include "import/mesh_import.h"

#include "import/mesh_cleanup.h"
#include "import/mesh_normals.h"
#include "import/number_text.h"
#include "import/ply.h"
#include "import/serialized.h"

#include <numbers>

namespace sundog
{

namespace
{

Bounds bounds_of_positions(const TriangleMesh& mesh)
{
    Bounds bounds;
    for (const Vec3 p : mesh.positions) bounds.extend(p);
    return bounds;
}

// Everything between a file's triangles and a shape's. `file`: as messages name it.
void finish_mesh(ObjectReader& reader, TriangleMesh& mesh, std::vector<int>& of_triangle, const std::string& file,
                 const Transform& to_world)
{
    require_valid_indices(mesh, reader.where(), file);
    require_finite_vertices(mesh, {file, 0}, "");
    transform_mesh(mesh, to_world, reader.boolean("flip_normals", false));
    require_finite_vertices(mesh, reader.where_of("to_world"), file);
    const std::size_t dropped = drop_degenerate_triangles(mesh, of_triangle);
    if (dropped > 0)
        reader.index().warn(reader.where(),
                            std::to_string(dropped) + " degenerate triangle" + (dropped == 1 ? "" : "s") + " of " + file + " dropped");
    if (!mesh.triangles.empty()) return;
    const std::string message = file + " has no triangles" + (dropped > 0 ? " but degenerate ones" : "");
    if (Bounds bounds = bounds_of_positions(mesh); is_far(bounds)) throw LostFarAway(reader.where(), message, bounds.center());
    throw SceneError(reader.where(), message);
}

// Whether the normals of the file are those of the shape.
bool keeps_normals(ObjectReader& reader)
{
    return !reader.boolean("face_normals", false) && !reader.has("max_smooth_angle");
}

// Says so, where faces are turned: what is outside is not what the winding says.
void turn_faces(ObjectReader& reader, TriangleMesh& mesh, const std::string& file)
{
    if (!reader.boolean("turn_faces", true)) return;
    const std::size_t turned = turn_opposed_faces(mesh);
    if (turned == 0) return;
    reader.index().warn(reader.where(), std::to_string(turned) + " of " + std::to_string(mesh.triangles.size()) + " triangles of " + file +
                                            (turned == 1 ? " was" : " were") +
                                            " turned: most normals of their vertices oppose the winding");
}

void set_normals(ObjectReader& reader, TriangleMesh& mesh, bool flat_in_file, const std::string& file)
{
    const bool flat = reader.boolean("face_normals", false);
    if (reader.has("max_smooth_angle")) {
        const double degrees = reader.number("max_smooth_angle", 0.0);
        if (!(degrees >= 0.0 && degrees <= 180.0))
            throw SceneError(reader.where_of("max_smooth_angle"), "'max_smooth_angle' must be from 0 to 180 degrees");
        if (flat)
            throw SceneError(reader.where_of("max_smooth_angle"), "'max_smooth_angle' and 'face_normals' exclude each other: remove one");
        smooth_up_to(mesh, degrees * std::numbers::pi / 180.0);
    } else if (flat || flat_in_file) {
        mesh.normals.clear();
    } else {
        turn_faces(reader, mesh, file);
        complete_normals(mesh); // as in Mitsuba, where the file has none
    }
}

// Of 32-bit numbers in the file, which no local origin makes finer.
void warn_of_steps(ObjectReader& reader, const MeshFile& file, const std::string& path)
{
    const Bounds bounds = bounds_of_positions(file.mesh);
    if (!file.single_precision || bounds.empty()) return;
    double largest = 0.0;
    const std::array<std::array<float, 3>, 2> corners = {
        {{bounds.lower.x, bounds.lower.y, bounds.lower.z}, {bounds.upper.x, bounds.upper.y, bounds.upper.z}}};
    for (const auto& corner : corners)
        for (std::size_t i = 0; i < 3; i++) largest = std::max(largest, std::abs(corner[i] + reader.counted_from()[i]));
    const double step = largest * 0x1p-23, size = 2.0 * bounds.radius();
    const double visible = reader.index().origins().world.is_set() ? 1e-4 : 1e-3;
    if (!(step > visible * size)) return;
    reader.index().warn(reader.where(),
                        "the vertices of " + path + " are 32-bit numbers up to " + rounded_text(largest) + ", in steps of " +
                            rounded_text(step) + ", of a mesh that is " + rounded_text(size) +
                            " large: its form is lost in the file; save it in double precision, or nearer to its origin",
                        WarningKind::approximated);
}

void finish_file_mesh(ObjectReader& reader, MeshFile& file, std::vector<int>& of_triangle, const std::filesystem::path& path)
{
    for (const Warning& warning : file.warnings) reader.index().warn({path.string(), 0}, warning.text, warning.kind);
    if (file.face_normals || !keeps_normals(reader)) file.mesh.normals.clear();
    warn_of_steps(reader, file, path.string());
    finish_mesh(reader, file.mesh, of_triangle, path.string(), reader.counted_to_world());
    set_normals(reader, file.mesh, file.face_normals, path.string());
}

TriangleMesh finish_generated(ObjectReader& reader, TriangleMesh mesh, const std::string& name)
{
    std::vector<int> none;
    finish_mesh(reader, mesh, none, name, reader.transform("to_world"));
    return mesh;
}

std::filesystem::path find_mesh_file(ObjectReader& reader)
{
    const std::string filename = reader.text("filename", "");
    return reader.index().find_file(filename, reader.where_of("filename"));
}

// The parameter, where there is one.
std::optional<int> shape_index(ObjectReader& reader)
{
    if (!reader.has("shape_index")) return {};
    const int index = reader.integer("shape_index", 0);
    if (index < 0) throw SceneError(reader.where_of("shape_index"), "'shape_index' must be >= 0, got " + std::to_string(index));
    return index;
}

PlyColors ply_colors(ObjectReader& reader)
{
    if (!reader.index().legacy()) return PlyColors::by_type;
    return reader.boolean("srgb", true) ? PlyColors::encoded : PlyColors::linear;
}

} // namespace

ObjFile import_obj(ObjectReader& reader, bool with_materials)
{
    const auto path = find_mesh_file(reader);
    ObjOptions options;
    options.with_materials = with_materials && reader.boolean("load_materials", true);
    options.with_normals = keeps_normals(reader);
    options.flip_tex_coords = reader.boolean("flip_tex_coords", true);
    options.shape_index = shape_index(reader);
    options.origin = reader.counted_from();
    ObjFile obj = load_obj(path, reader.where_of("filename"), options);
    if (options.shape_index && static_cast<std::size_t>(*options.shape_index) >= obj.shapes)
        throw SceneError(reader.where_of("shape_index"), "shape_index is " + std::to_string(*options.shape_index) + ", but '" +
                                                             path.string() + "' has " + std::to_string(obj.shapes) +
                                                             " shapes (counted from 0)");
    reader.ignore("collapse", "the shapes of an OBJ file are always one");
    reader.ignore("load_materials", "the shape has a <bsdf>");
    finish_file_mesh(reader, obj, obj.material_of_triangle, path);
    return obj;
}

TriangleMesh import_ply(ObjectReader& reader)
{
    const auto path = find_mesh_file(reader);
    PlyOptions options;
    options.flip_tex_coords = reader.boolean("flip_tex_coords", false);
    options.colors = ply_colors(reader);
    options.origin = reader.counted_from();
    MeshFile ply = load_ply(path, reader.where_of("filename"), options);
    std::vector<int> none;
    finish_file_mesh(reader, ply, none, path);
    return std::move(ply.mesh);
}

TriangleMesh import_serialized(ObjectReader& reader)
{
    const auto path = find_mesh_file(reader);
    const int index = shape_index(reader).value_or(0);
    const SourceLocation wanted_at = index > 0 ? reader.where_of("shape_index") : reader.where_of("filename");
    MeshFile file = load_serialized(path, wanted_at, index, reader.counted_from());
    std::vector<int> none;
    finish_file_mesh(reader, file, none, path);
    return std::move(file.mesh);
}

TriangleMesh import_rectangle(ObjectReader& reader)
{
    TriangleMesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return finish_generated(reader, std::move(mesh), "the rectangle");
}

TriangleMesh import_cube(ObjectReader& reader)
{
    // Each face spans normal + a * u + b * v for a, b in [-1, 1], with texture coordinates ((a + 1) / 2, (b + 1) / 2):
    // where Mitsuba has them. u x v points inwards.
    struct Face {
        Vec3 normal, u, v;
    };
    constexpr Face faces[] = {{{0, -1, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                              {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},  {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}};
    TriangleMesh mesh;
    for (const Face& face : faces) {
        const auto base = static_cast<uint>(mesh.positions.size());
        for (const Vec2 uv : {Vec2{0, 0}, Vec2{0, 1}, Vec2{1, 1}, Vec2{1, 0}}) {
            mesh.positions.push_back(face.normal + (2.0f * uv.x - 1.0f) * face.u + (2.0f * uv.y - 1.0f) * face.v);
            mesh.uvs.push_back(uv);
        }
        mesh.triangles.push_back({base, base + 1, base + 2});
        mesh.triangles.push_back({base, base + 2, base + 3});
    }
    return finish_generated(reader, std::move(mesh), "the cube");
}

} // namespace sundog
