#include "scene/flat_scene.h"

#include "scene/flatten_bsdfs.h"
#include "scene/flatten_textures.h"
#include "scene/light_list.h"

#include <algorithm>

namespace sundog {

namespace {

struct ShapeFlattener {
    FlatScene& flat;
    uint index;
    Shape& shape;

    void operator()(const TriangleMesh& mesh) const
    {
        const uint base = static_cast<uint>(flat.positions.size());
        shape.first_primitive = static_cast<uint>(flat.triangles.size());
        flat.positions.insert(flat.positions.end(), mesh.positions.begin(), mesh.positions.end());
        if (!mesh.normals.empty()) {
            shape.flags |= SHAPE_HAS_NORMALS;
            flat.normals.resize(base, Vec3{});
            flat.normals.insert(flat.normals.end(), mesh.normals.begin(), mesh.normals.end());
        }
        if (!mesh.uvs.empty()) {
            shape.flags |= SHAPE_HAS_UVS;
            flat.uvs.resize(base, Vec2{});
            flat.uvs.insert(flat.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
        }
        for (const auto& t : mesh.triangles) flat.triangles.push_back({{base + t[0], base + t[1], base + t[2]}, index});
    }

    void operator()(const Sphere& sphere) const
    {
        if (sphere.flip_normals) shape.flags |= SHAPE_FLIP_NORMALS;
        AnalyticPrimitive primitive{};
        primitive.kind = ANALYTIC_SPHERE;
        primitive.center = sphere.center;
        primitive.radius = sphere.radius;
        primitive.axis_u = sphere.axis_x;
        primitive.axis_v = sphere.axis_y;
        primitive.normal = sphere.axis_z;
        add(primitive);
    }

    void operator()(const Disk& disk) const
    {
        AnalyticPrimitive primitive{};
        primitive.kind = ANALYTIC_DISK;
        primitive.center = disk.center;
        primitive.axis_u = disk.axis_u;
        primitive.axis_v = disk.axis_v;
        primitive.normal = disk.normal();
        add(primitive);
    }

    void operator()(const Cylinder& cylinder) const
    {
        if (cylinder.flip_normals) shape.flags |= SHAPE_FLIP_NORMALS;
        AnalyticPrimitive primitive{};
        primitive.kind = ANALYTIC_CYLINDER;
        primitive.center = cylinder.start;
        primitive.radius = cylinder.radius;
        primitive.length = cylinder.length;
        primitive.axis_u = cylinder.axis_x;
        primitive.axis_v = cylinder.axis_y;
        primitive.normal = cylinder.axis_z;
        add(primitive);
    }

    void add(AnalyticPrimitive primitive) const
    {
        shape.first_primitive = static_cast<uint>(flat.analytics.size());
        primitive.shape = index;
        flat.analytics.push_back(primitive);
    }
};

// Some of the shapes, as one range.
template <class Chosen> PrimitiveRange flatten_shapes(const Scene& scene, FlatScene& flat, const Chosen& is_chosen)
{
    PrimitiveRange range;
    range.first_triangle = static_cast<uint>(flat.triangles.size());
    range.first_analytic = static_cast<uint>(flat.analytics.size());
    for (uint i = 0; i < scene.shapes.size(); i++)
        if (is_chosen(scene.shapes[i])) std::visit(ShapeFlattener{flat, i, flat.shapes[i]}, scene.shapes[i].geometry);
    range.triangle_count = static_cast<uint>(flat.triangles.size()) - range.first_triangle;
    range.analytic_count = static_cast<uint>(flat.analytics.size()) - range.first_analytic;
    return range;
}

void flatten_all_shapes(const Scene& scene, FlatScene& flat)
{
    const auto is_hidden = [&](const ShapeDescription& shape) { return flat.hides_emitters && shape.emitter; };
    flat.world = flatten_shapes(scene, flat, [&](const ShapeDescription& shape) { return !shape.group && !is_hidden(shape); });
    flat.hidden = flatten_shapes(scene, flat, is_hidden); // groups hold no lights
    for (uint group = 0; group < scene.groups.size(); group++)
        flat.groups.push_back(flatten_shapes(scene, flat, [&](const ShapeDescription& shape) { return shape.group == group; }));
}

Vec3 row(const Transform& t, std::size_t i)
{
    return {static_cast<float>(t.m[i][0]), static_cast<float>(t.m[i][1]), static_cast<float>(t.m[i][2])};
}

void check_range(const Instance& instance, const SourceLocation& where)
{
    for (std::size_t i = 0; i < 3; i++)
        if (!is_finite(instance.to_world[i]) || !is_finite(instance.to_object[i]) || !is_finite(instance.translation))
            throw SceneError(where, "to_world of the instance scales too much for 32-bit numbers");
}

void flatten_instance(const InstanceDescription& description, FlatScene& flat)
{
    const auto& [open, close] = flat.shutter;
    Instance instance{};
    if (description.to_world.moves(open, close)) {
        for (const TransformKey& key : description.to_world.keys()) { // between them nothing is larger
            place(key.transform, instance);
            check_range(instance, description.where);
        }
        flat.instance_motions.push_back({static_cast<uint>(flat.instances.size()), description.to_world});
    }
    place(description.to_world.at(open), instance);
    check_range(instance, description.where);
    flat.instances.push_back(instance);
    flat.instance_groups.push_back(description.group);
}

} // namespace

FlatScene flatten_scene(const Scene& scene)
{
    FlatScene flat;
    flat.bsdfs = flatten_bsdfs(scene.bsdfs);
    flat.principled = flatten_principled(scene.bsdfs);
    flatten_textures(scene, flat);
    for (const auto& description : scene.shapes) flat.shapes.push_back({description.bsdf, NO_LIGHT, 0, 0});
    flat.hides_emitters = scene.integrator.hide_emitters;
    flatten_all_shapes(scene, flat);
    flat.shutter = scene.sensor.shutter;
    if (scene.sensor.motion && scene.sensor.motion->moves(flat.shutter.open, flat.shutter.close)) flat.sensor_motion = scene.sensor.motion;
    for (const auto& instance : scene.instances) flatten_instance(instance, flat);
    if (!flat.normals.empty()) flat.normals.resize(flat.positions.size(), Vec3{});
    if (!flat.uvs.empty()) flat.uvs.resize(flat.positions.size(), Vec2{});
    list_attributes(scene, flat);

    Bounds bounds = scene.bounds();
    if (bounds.empty()) bounds.extend(scene.sensor.position); // lights alone
    flat.globals.center = bounds.center();
    // A little more than the half diagonal, so that rays from the sphere start outside of everything.
    flat.globals.radius = std::max(bounds.radius() * 1.001f, 1e-20f);
    list_lights(scene, flat);
    return flat;
}

void place(const Transform& to_world, Instance& instance)
{
    const Transform to_object = to_world.inverse();
    for (std::size_t i = 0; i < 3; i++) {
        instance.to_world[i] = row(to_world, i);
        instance.to_object[i] = row(to_object, i);
    }
    instance.translation = to_world.point({0, 0, 0});
}

bool has_focused_light(const FlatScene& flat)
{
    const auto is_collimated = [](const Light& light) { return light.type == LIGHT_COLLIMATED; };
    return has_focusing_lobes(flat.bsdfs) || std::any_of(flat.lights.begin(), flat.lights.end(), is_collimated);
}

bool has_delta_lights(const FlatScene& flat)
{
    return std::any_of(flat.lights.begin(), flat.lights.end(), [](const Light& light) { return LIGHT_IS_DELTA(light.type); });
}

uint light_types(const FlatScene& flat)
{
    uint types = 0;
    for (const Light& light : flat.lights) types |= 1u << light.type;
    return types;
}

bool needs_texture_coordinates(const FlatScene& flat)
{
    const auto anisotropic = [](const Bsdf& bsdf) { return bsdf.alpha_u.value != bsdf.alpha_v.value || bsdf.alpha_u.texture != bsdf.alpha_v.texture; };
    const auto relief = [](const Bsdf& bsdf) { return bsdf.type == BSDF_NORMAL_MAP || bsdf.type == BSDF_BUMP_MAP; };
    const auto brushed = [](const Principled& principled) { return principled.anisotropic.value != 0.0f; };
    return !flat.textures.empty() || std::any_of(flat.principled.begin(), flat.principled.end(), brushed) || std::any_of(flat.bsdfs.begin(), flat.bsdfs.end(), relief) ||
           std::any_of(flat.bsdfs.begin(), flat.bsdfs.end(), anisotropic);
}

Camera make_camera(const Sensor& sensor, const Film& film)
{
    Camera camera{};
    camera.position = sensor.position;
    camera.axis_x = sensor.axis_x;
    camera.axis_y = sensor.axis_y;
    camera.axis_z = sensor.axis_z;
    const bool orthographic = sensor.projection == Projection::orthographic;
    camera.kind = orthographic ? CAMERA_ORTHOGRAPHIC : CAMERA_PERSPECTIVE;
    camera.half_width = orthographic ? sensor.extent_x : std::tan(0.5f * sensor.fov_x);
    camera.half_height = (orthographic ? sensor.extent_y : camera.half_width) * static_cast<float>(film.height) / static_cast<float>(film.width);
    camera.shift_x = -2.0f * sensor.principal_offset_x * camera.half_width;
    camera.shift_y = -2.0f * sensor.principal_offset_y * camera.half_height;
    camera.aperture_radius = sensor.aperture_radius;
    camera.focus_distance = sensor.focus_distance;
    camera.near_clip = sensor.near_clip;
    camera.far_clip = sensor.far_clip;
    camera.film_width = film.width;
    camera.film_height = film.height;
    camera.crop_x = film.crop_x;
    camera.crop_y = film.crop_y;
    camera.crop_width = film.crop_width;
    camera.crop_height = film.crop_height;
    return camera;
}

} // namespace sundog
