#include "import/shape_import.h"

#include "import/animation_import.h"
#include "import/emitter_import.h"
#include "import/mesh_import.h"
#include "import/mesh_parts.h"
#include "math/direction.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace sundog
{

namespace
{

Sphere import_sphere(ObjectReader& reader)
{
    const Vec3 center = reader.point("center", {0, 0, 0});
    const double radius = reader.positive("radius", 1.0);
    const Transform to_world = reader.transform("to_world");
    const auto scale = to_world.uniform_scale();
    if (!scale)
        throw SceneError(reader.where_of("to_world"), "to_world of a sphere must scale evenly and not shear: use a mesh for an ellipsoid");
    Sphere sphere;
    sphere.center = reader.counted_to_world().point(center);
    sphere.radius = static_cast<float>(radius * *scale);
    sphere.flip_normals = reader.boolean("flip_normals", false);
    sphere.axis_x = direction_of(to_world.vector({1, 0, 0}));
    sphere.axis_y = direction_of(to_world.vector({0, 1, 0}));
    sphere.axis_z = direction_of(to_world.vector({0, 0, 1}));
    if (!is_finite(sphere.center) || !std::isfinite(sphere.radius))
        throw SceneError(reader.where_of("to_world"), "the sphere is too large for 32-bit numbers");
    if (!(sphere.radius > 0.0f)) throw SceneError(reader.where(), "the sphere is too small for 32-bit numbers");
    return sphere;
}

Disk import_disk(ObjectReader& reader)
{
    const Transform to_world = reader.transform("to_world");
    Disk disk{to_world.point({0, 0, 0}), to_world.vector({1, 0, 0}), to_world.vector({0, 1, 0})};
    // The normal is that of +z, outside of which a reflection must not change.
    disk.flip_normals = (to_world.determinant() < 0.0) != reader.boolean("flip_normals", false);
    if (!is_finite(disk.center) || !is_finite(disk.axis_u) || !is_finite(disk.axis_v))
        throw SceneError(reader.where_of("to_world"), "the disk is too large for 32-bit numbers");
    return disk;
}

// The frame around the axis of Mitsuba's cylinders, where their texture coordinates begin.
std::pair<Vec3, Vec3> frame_around(Vec3 z, bool legacy)
{
    if (legacy) {
        const Vec3 y = std::abs(z.x) > std::abs(z.y) ? normalize(Vec3{z.z, 0, -z.x}) : normalize(Vec3{0, z.z, -z.y});
        return {cross(y, z), y};
    }
    // [Duff et al. 2017, "Building an Orthonormal Basis, Revisited"]
    const float sign = std::copysign(1.0f, z.z), a = -1.0f / (sign + z.z), b = z.x * z.y * a;
    return {{1.0f + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}};
}

Cylinder import_cylinder(ObjectReader& reader)
{
    const Vec3 p0 = reader.point("p0", {0, 0, 0}), p1 = reader.point("p1", {0, 0, 1});
    const double radius = reader.positive("radius", 1.0);
    const Transform to_world = reader.transform("to_world");
    if (!(length(p1 - p0) > 0.0f) || !is_finite(p1 - p0))
        throw SceneError(reader.where_of("p1"), "the cylinder needs two different end points 'p0' and 'p1'");
    const auto [z, height] = direction_and_length(p1 - p0);
    const auto [x, y] = frame_around(z, reader.index().legacy());
    const auto [axis_z, stretch] = direction_and_length(to_world.vector(z));
    const auto [axis_x, width] = direction_and_length(to_world.vector(x));
    const auto [axis_y, width_y] = direction_and_length(to_world.vector(y));

    Cylinder cylinder;
    cylinder.start = reader.counted_to_world().point(p0);
    cylinder.length = height * stretch;
    cylinder.radius = static_cast<float>(radius * width);
    if (!is_finite(cylinder.start) || !std::isfinite(cylinder.length) || !std::isfinite(cylinder.radius))
        throw SceneError(reader.where_of("to_world"), "the cylinder is too large for 32-bit numbers");
    if (!(cylinder.radius > 0.0f) || !(cylinder.length > 0.0f))
        throw SceneError(reader.where(), "the cylinder is too small for 32-bit numbers");
    cylinder.axis_x = axis_x;
    cylinder.axis_y = axis_y;
    cylinder.axis_z = axis_z;
    // Still round, and still upright.
    constexpr float tolerance = 1e-3f;
    const bool even = std::abs(width_y - width) <= tolerance * width;
    if (!even || std::abs(dot(cylinder.axis_x, cylinder.axis_y)) > tolerance ||
        std::abs(dot(cylinder.axis_x, cylinder.axis_z)) > tolerance || std::abs(dot(cylinder.axis_y, cylinder.axis_z)) > tolerance)
        throw SceneError(reader.where_of("to_world"),
                         "to_world of a cylinder must scale evenly across the axis and not shear: use a mesh for elliptic or oblique ones");
    cylinder.flip_normals = reader.boolean("flip_normals", false);
    return cylinder;
}

bool is_supported(const std::string& type)
{
    constexpr const char* types[] = {"obj", "ply", "serialized", "rectangle", "cube", "sphere", "disk", "cylinder"};
    return std::find(std::begin(types), std::end(types), type) != std::end(types);
}

// Shapes that Mitsuba has and Sundog does not, each with the way around it.
void leave_out(ObjectReader& reader)
{
    constexpr const char* as_mesh = "convert it to a mesh (ply or obj)";
    static const std::map<std::string, const char*> cures = {
        {"heightfield", as_mesh},
        {"hair", "make tubes of the strands, as a mesh (ply or obj)"},
        {"bsplinecurve", "make tubes of the curves, as a mesh (ply or obj)"},
        {"linearcurve", "make tubes of the curves, as a mesh (ply or obj)"},
        {"sdfgrid", "extract the surface at distance zero as a mesh (ply or obj)"},
        {"ellipsoids", as_mesh},
        {"ellipsoidsmesh", as_mesh},
        {"deformable", "save the mesh of the wanted instant (ply or obj)"},
        {"merge", "put its shapes into the scene themselves"},
    };
    const auto cure = cures.find(reader.type());
    reader.missing(cure != cures.end() ? std::string(": ") + cure->second
                                       : "; supported are obj, ply, serialized, rectangle, cube, sphere, disk, cylinder, shapegroup, instance",
                   "it is left out");
}

class ShapeImport
{
public:
    ShapeImport(const XmlElement& element, const SceneIndex& index, BsdfImporter& bsdfs, TextureImporter& textures, Scene& scene,
                std::optional<uint> group)
        : reader_(element, index), bsdfs_(bsdfs), textures_(textures), scene_(scene)
    {
        const std::string* id = element.attribute("id");
        common_.id = id ? *id : "";
        common_.where = element.where;
        common_.group = group;
    }

    void run()
    {
        const std::string type = reader_.type();
        if (!is_supported(type)) return leave_out(reader_);
        const auto emitter = reader_.single("emitter");
        if (emitter) common_.emitter = import_area_emitter(*emitter->object, reader_.index(), textures_);
        read_placement(emitter);
        const auto bsdf = reader_.single("bsdf");
        if (type == "obj" && !bsdf) {
            add_obj_with_materials();
        } else {
            auto geometry = read_geometry(type);
            add(std::move(geometry), bsdf ? bsdfs_.import(*bsdf->object) : default_bsdf());
        }
        reader_.finish();
    }

private:
    // A shape that moves is the only one of a group, which has one instance.
    void read_placement(const std::optional<NestedObject>& emitter)
    {
        const AnimatedTransform to_world = read_to_world(reader_, scene_.sensor.shutter);
        if (to_world.is_constant()) return place(to_world.at(0.0));
        if (emitter)
            throw SceneError(emitter->where,
                             "a shape that moves cannot emit light: let the light stand still, by a <transform> in place of "
                             "the <animation>");
        common_.group = static_cast<uint>(scene_.groups.size());
        place(Transform());
        scene_.groups.push_back({common_.id, common_.where});
        scene_.instances.push_back(
            {common_.id, common_.where, *common_.group, to_world.relative_to(reader_.index().origins().world.place)});
    }

    // Where the shape's own origin is far from all that is around the local one, places of the shape are counted from the
    // latter, before they lose their digits.
    void place(const Transform& to_world)
    {
        const LocalOrigin origin = reader_.index().origins().of(common_.group);
        const Transform to_local = to_world.relative_to(origin.place);
        const Double3 own = to_local.exact_point({0, 0, 0});
        const bool far = origin.is_set() && std::sqrt(dot(own, own)) > far_in_radii * origin.radius;
        reader_.place(to_local, far ? to_local.inverse().exact_point({0, 0, 0}) : Double3{0, 0, 0});
    }

    decltype(ShapeDescription::geometry) read_geometry(const std::string& type)
    {
        if (type == "obj") return import_obj(reader_, false).mesh;
        if (type == "ply") return import_ply(reader_);
        if (type == "serialized") return import_serialized(reader_);
        if (type == "rectangle") return import_rectangle(reader_);
        if (type == "cube") return import_cube(reader_);
        if (type == "sphere") return import_sphere(reader_);
        if (type == "disk") return import_disk(reader_);
        return import_cylinder(reader_);
    }

    void add_obj_with_materials()
    {
        ObjFile obj = import_obj(reader_, true);
        if (obj.materials.empty()) {
            add(std::move(obj.mesh), default_bsdf());
            return;
        }
        std::map<int, std::vector<uint>> triangles; // of each material; -1 for those without one
        for (std::size_t i = 0; i < obj.material_of_triangle.size(); i++)
            triangles[obj.material_of_triangle[i]].push_back(static_cast<uint>(i));
        for (const auto& [material, wanted] : triangles)
            add(extract_triangles(obj.mesh, wanted),
                material < 0 ? default_bsdf() : obj_bsdf(obj.materials[static_cast<std::size_t>(material)]));
    }

    uint obj_bsdf(const ObjMaterial& material)
    {
        if (material.diffuse_image) {
            try {
                const WrapMode wrap = material.image_repeats ? WrapMode::repeat : WrapMode::clamp;
                return bsdfs_.add_diffuse(material.name, common_.where, textures_.image(*material.diffuse_image, common_.where, wrap));
            } catch (const SceneError& error) {
                reader_.index().warn({}, std::string(error.what()) + "; material '" + material.name + "' takes its Kd", WarningKind::approximated);
            }
        }
        const Vec3 clamped = min(max(material.diffuse, Vec3{0, 0, 0}), Vec3{1, 1, 1});
        if (!(clamped == material.diffuse))
            reader_.index().warn(common_.where, "Kd of material '" + material.name + "' is outside of [0, 1] and was clamped", WarningKind::approximated);
        return bsdfs_.add_diffuse(material.name, common_.where, clamped);
    }

    // As in Mitsuba: gray, but black for what emits.
    uint default_bsdf() { return bsdfs_.add_diffuse("", common_.where, common_.emitter ? Vec3{0, 0, 0} : Vec3{0.5f, 0.5f, 0.5f}); }

    void add(decltype(ShapeDescription::geometry) geometry, uint bsdf)
    {
        ShapeDescription shape = common_;
        shape.geometry = std::move(geometry);
        shape.bsdf = bsdf;
        scene_.shapes.push_back(std::move(shape));
    }

    ObjectReader reader_;
    BsdfImporter& bsdfs_;
    TextureImporter& textures_;
    Scene& scene_;
    ShapeDescription common_;
};

} // namespace

void import_shape(const XmlElement& element, const SceneIndex& index, BsdfImporter& bsdfs, TextureImporter& textures, Scene& scene,
                  std::optional<uint> group)
{
    ShapeImport(element, index, bsdfs, textures, scene, group).run();
}

} // namespace sundog
