#include "import/shape_writer.h"

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

void write_emitter(ObjectWriter shape, const AreaEmitter& emitter)
{
    shape.object("emitter", "area").color("radiance", emitter.radiance);
}

} // namespace

void write_shapes(ObjectWriter root, const Scene& scene, WrittenIds& ids, const BsdfWriter& bsdfs, WrittenFiles& files)
{
    for (std::size_t i = 0; i < scene.shapes.size(); i++) {
        // All members, so that one that is added does not compile until it is written here.
        const auto& [id, where, geometry, bsdf, emitter] = scene.shapes[i];
        ShapeWriter writer(root, files, i, ids.add(id, "shape", i));
        ObjectWriter object = std::visit([&](const auto& alternative) { return writer.write(alternative); }, geometry);
        object.reference(bsdfs.id(bsdf));
        if (emitter) write_emitter(object, *emitter);
    }
}

} // namespace sundog
