#include "import/shape_writer.h"

#include "import/mesh_normals.h"
#include "math/double3.h"

namespace sundog
{

namespace
{

Double3 to_double(Vec3 v)
{
    return {v.x, v.y, v.z};
}

Transform frame(const Double3& x, const Double3& y, const Double3& z, Vec3 origin)
{
    const Double3 o = to_double(origin);
    Transform t;
    for (std::size_t i = 0; i < 3; i++) t.m[i] = {x[i], y[i], z[i], o[i]};
    return t;
}

// Of unit length, so that the determinant of a frame with it is the area that u and v span.
Double3 unit_normal(const Double3& u, const Double3& v)
{
    const Double3 n = cross(u, v);
    const double length = std::sqrt(dot(n, n));
    return {n[0] / length, n[1] / length, n[2] / length};
}

// The map of the square [-1, 1]^2 that gives these corners to the last bit, if it does.
std::optional<Transform> rectangle_transform(const TriangleMesh& mesh)
{
    constexpr Vec3 corners[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    constexpr Vec2 uvs[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    if (mesh.positions.size() != 4 || mesh.triangles.size() != 2 || mesh.uvs.size() != 4 || !mesh.normals.empty() ||
        !mesh.attributes.empty())
        return {};
    const auto& p = mesh.positions;
    Double3 u, v, center;
    for (std::size_t i = 0; i < 3; i++) {
        const double a = to_double(p[0])[i], b = to_double(p[1])[i], c = to_double(p[2])[i], d = to_double(p[3])[i];
        u[i] = 0.25 * ((b - a) + (c - d));
        v[i] = 0.25 * ((d - a) + (c - b));
        center[i] = 0.25 * (a + b + c + d);
    }
    Transform t = frame(u, v, unit_normal(u, v), {0, 0, 0});
    for (std::size_t i = 0; i < 3; i++) t.m[i][3] = center[i];
    if (t.is_singular() || !t.is_finite()) return {};
    for (std::size_t i = 0; i < 4; i++)
        if (!(t.point(corners[i]) == p[i]) || mesh.uvs[i].x != uvs[i].x || mesh.uvs[i].y != uvs[i].y) return {};
    return t;
}

class ShapeWriter
{
public:
    ShapeWriter(ObjectWriter root, WrittenFiles& files, std::size_t number, const std::string& id)
        : root_(root), files_(files), number_(number), id_(id)
    {
    }

    // One of each alternative of ShapeDescription::geometry. Each returns the shape, for what else belongs into it.
    ObjectWriter write(const TriangleMesh& mesh)
    {
        if (const auto to_world = rectangle_transform(mesh)) {
            const auto& t = mesh.triangles;
            const bool outward = t[0] == std::array<uint, 3>{0, 1, 2} && t[1] == std::array<uint, 3>{0, 2, 3};
            const bool flipped = t[0] == std::array<uint, 3>{0, 2, 1} && t[1] == std::array<uint, 3>{0, 3, 2};
            if (outward || flipped) return placed("rectangle", *to_world, flipped);
        }
        ObjectWriter object = root_.object("shape", "ply", "", id_);
        object.text("filename", files_.add_mesh(mesh, number_));
        if (mesh.normals.empty()) object.boolean("face_normals", true);
        if (has_opposed_faces(mesh)) object.boolean("turn_faces", false);
        return object;
    }

    ObjectWriter write(const Sphere& sphere)
    {
        const Transform to_world = frame(to_double(sphere.axis_x), to_double(sphere.axis_y), to_double(sphere.axis_z), sphere.center);
        ObjectWriter object = placed("sphere", to_world, sphere.flip_normals);
        // Axes are of unit length but for rounding; the reader multiplies by what that makes of their scale.
        if (const double scale = to_world.uniform_scale().value_or(1.0); scale != 1.0)
            object.number("radius", sphere.radius / scale);
        else
            object.number("radius", sphere.radius);
        return object;
    }

    ObjectWriter write(const Disk& disk)
    {
        const Double3 u = to_double(disk.axis_u), v = to_double(disk.axis_v);
        return placed("disk", frame(u, v, unit_normal(u, v), disk.center), disk.flip_normals);
    }

    ObjectWriter write(const Cylinder& cylinder)
    {
        const Transform to_world =
            frame(to_double(cylinder.axis_x), to_double(cylinder.axis_y), to_double(cylinder.axis_z), cylinder.start);
        ObjectWriter object = placed("cylinder", to_world, cylinder.flip_normals);
        object.vector("point", "p0", {0, 0, 0});
        object.vector("point", "p1", {0, 0, cylinder.length});
        object.number("radius", cylinder.radius);
        return object;
    }

private:
    ObjectWriter placed(const char* type, const Transform& to_world, bool flip_normals)
    {
        ObjectWriter object = root_.object("shape", type, "", id_);
        object.transform("to_world", to_world);
        if (flip_normals) object.boolean("flip_normals", true);
        return object;
    }

    ObjectWriter root_;
    WrittenFiles& files_;
    std::size_t number_;
    std::string id_;
};

// The shapes, groups and instances of a scene. A reader imports a group for its first instance, so that its shapes come
// after those that are before that instance: the first shape of a group is where the instance was.
class ShapesWriter
{
public:
    ShapesWriter(ObjectWriter root, const Scene& scene, WrittenIds& ids, const TextureWriter& textures, const BsdfWriter& bsdfs,
                 WrittenFiles& files)
        : root_(root), scene_(scene), ids_(ids), textures_(textures), bsdfs_(bsdfs), files_(files), groups_(scene.groups.size())
    {
    }

    void write()
    {
        for (std::size_t i = 0; i < scene_.shapes.size(); i++) {
            const auto group = scene_.shapes[i].group;
            write_shape(group ? group_object(*group) : root_, i);
        }
        while (next_instance_ < scene_.instances.size()) write_instance();
    }

private:
    struct Group {
        std::string id;
        std::optional<ObjectWriter> object;
    };

    ObjectWriter group_object(uint index)
    {
        Group& group = groups_[index];
        if (!group.object) {
            const auto& [id, where] = scene_.groups[index]; // all members, as below
            group.id = ids_.add(id, "group", index);
            group.object = root_.object("shape", "shapegroup", "", group.id);
            bool first = false;
            while (!first && next_instance_ < scene_.instances.size()) {
                first = scene_.instances[next_instance_].group == index;
                write_instance();
            }
        }
        return *group.object;
    }

    void write_instance()
    {
        const auto& [id, where, group, to_world] = scene_.instances[next_instance_];
        if (!groups_[group].object) throw SceneError(where, "--dump cannot write an instance whose group is empty or comes later");
        ObjectWriter object = root_.object("shape", "instance", "", ids_.add(id, "instance", next_instance_));
        object.reference(groups_[group].id);
        object.transform("to_world", to_world);
        next_instance_++;
    }

    void write_shape(ObjectWriter parent, std::size_t i)
    {
        // All members, so that one that is added does not compile until it is written here.
        const auto& [id, where, geometry, bsdf, emitter, group] = scene_.shapes[i];
        ShapeWriter writer(parent, files_, i, ids_.add(id, "shape", i));
        ObjectWriter object = std::visit([&](const auto& alternative) { return writer.write(alternative); }, geometry);
        object.reference(bsdfs_.id(bsdf));
        if (emitter) write_emitter(object, *emitter);
    }

    void write_emitter(ObjectWriter shape, const AreaEmitter& emitter)
    {
        const auto& [radiance, texture] = emitter;
        textures_.color(shape.object("emitter", "area"), "radiance", texture ? ColorSource(radiance, *texture) : ColorSource(radiance));
    }

    ObjectWriter root_;
    const Scene& scene_;
    WrittenIds& ids_;
    const TextureWriter& textures_;
    const BsdfWriter& bsdfs_;
    WrittenFiles& files_;
    std::vector<Group> groups_; // as scene_.groups
    std::size_t next_instance_ = 0;
};

} // namespace

void write_shapes(ObjectWriter root, const Scene& scene, WrittenIds& ids, const TextureWriter& textures, const BsdfWriter& bsdfs,
                  WrittenFiles& files)
{
    ShapesWriter(root, scene, ids, textures, bsdfs, files).write();
}

} // namespace sundog
