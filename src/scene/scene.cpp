#include "scene/scene.h"

namespace sundog {

namespace {

Bounds bounds_of(const TriangleMesh& mesh)
{
    Bounds b;
    for (const auto& triangle : mesh.triangles)
        for (uint v : triangle) b.extend(mesh.positions[v]);
    return b;
}

Bounds bounds_of(const Sphere& sphere)
{
    const Vec3 r{sphere.radius, sphere.radius, sphere.radius};
    return {sphere.center - r, sphere.center + r};
}

Bounds bounds_of(const Disk& disk)
{
    // The ellipse's reach along an axis is the length of (u, v) on that axis.
    const Vec3 r{std::hypot(disk.axis_u.x, disk.axis_v.x), std::hypot(disk.axis_u.y, disk.axis_v.y),
                 std::hypot(disk.axis_u.z, disk.axis_v.z)};
    return {disk.center - r, disk.center + r};
}

Bounds bounds_of(const Cylinder& cylinder)
{
    const Vec3 end = cylinder.start + cylinder.axis_z * cylinder.length;
    const Vec3 r = Vec3{std::hypot(cylinder.axis_x.x, cylinder.axis_y.x), std::hypot(cylinder.axis_x.y, cylinder.axis_y.y),
                        std::hypot(cylinder.axis_x.z, cylinder.axis_y.z)} *
                   cylinder.radius;
    return {min(cylinder.start, end) - r, max(cylinder.start, end) + r};
}

std::size_t triangles_of(const ShapeDescription& shape)
{
    const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
    return mesh ? mesh->triangles.size() : 0;
}

} // namespace

Vec3 Disk::normal() const
{
    const Vec3 n = normalize(cross(axis_u, axis_v));
    return flip_normals ? -n : n;
}

Bounds ShapeDescription::bounds() const
{
    return std::visit([](const auto& g) { return bounds_of(g); }, geometry);
}

double TextureDescription::aspect() const
{
    const auto* bitmap = std::get_if<BitmapTexture>(&model);
    return bitmap ? static_cast<double>(bitmap->image->width) / bitmap->image->height : 1.0;
}

std::size_t Scene::triangle_count() const
{
    std::size_t count = 0;
    for (const auto& shape : shapes) count += triangles_of(shape);
    return count;
}

std::size_t Scene::triangle_count_with_copies() const
{
    std::vector<std::size_t> of_group(groups.size());
    std::size_t count = 0;
    for (const auto& shape : shapes) (shape.group ? of_group[*shape.group] : count) += triangles_of(shape);
    for (const auto& instance : instances) count += of_group[instance.group];
    return count;
}

bool Scene::has_dispersion() const
{
    return std::any_of(bsdfs.begin(), bsdfs.end(), [](const BsdfDescription& bsdf) {
        const auto* dielectric = std::get_if<DielectricBsdf>(&bsdf.model);
        return dielectric && dielectric->dispersion;
    });
}

Bounds Scene::bounds() const
{
    Bounds all;
    std::vector<Bounds> of_group(groups.size());
    for (const auto& shape : shapes) (shape.group ? of_group[*shape.group] : all).extend(shape.bounds());
    for (const auto& instance : instances) {
        const Bounds& group = of_group[instance.group];
        const auto [open, close] = sensor.shutter;
        all.extend(instance.to_world.moves(open, close) ? instance.to_world.box(group, open, close)
                                                        : instance.to_world.at(open).box(group));
    }
    return all;
}

bool Scene::moves() const
{
    const auto moves = [&](const AnimatedTransform& t) { return t.moves(sensor.shutter.open, sensor.shutter.close); };
    return (sensor.motion && moves(*sensor.motion)) ||
           std::any_of(instances.begin(), instances.end(), [&](const InstanceDescription& i) { return moves(i.to_world); });
}

} // namespace sundog
