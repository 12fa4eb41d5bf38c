#include "scene/flat_scene.h"

#include "scene/light_list.h"

#include <algorithm>

namespace sundog {

namespace {

Bsdf flatten(const DiffuseBsdf& diffuse)
{
    Bsdf bsdf{};
    bsdf.type = BSDF_DIFFUSE;
    bsdf.reflectance = diffuse.reflectance;
    return bsdf;
}

Bsdf flatten(const DielectricBsdf& dielectric)
{
    Bsdf bsdf{};
    bsdf.type = dielectric.thin ? BSDF_THIN_DIELECTRIC : BSDF_DIELECTRIC;
    bsdf.eta = dielectric.int_ior / dielectric.ext_ior;
    bsdf.reflectance = dielectric.specular_reflectance;
    bsdf.transmittance = dielectric.specular_transmittance;
    return bsdf;
}

Bsdf flatten(const ConductorBsdf& conductor)
{
    Bsdf bsdf{};
    bsdf.type = BSDF_CONDUCTOR;
    bsdf.reflectance = conductor.specular_reflectance;
    bsdf.eta_rgb = conductor.eta;
    bsdf.k_rgb = conductor.k;
    return bsdf;
}

Bsdf flatten(const NullBsdf&)
{
    Bsdf bsdf{};
    bsdf.type = BSDF_NULL;
    return bsdf;
}

// A two-sided BSDF is its front's record that names the back's, itself a record of its own.
std::vector<Bsdf> flatten_bsdfs(const std::vector<BsdfDescription>& descriptions)
{
    std::vector<Bsdf> bsdfs(descriptions.size());
    for (std::size_t i = 0; i < descriptions.size(); i++) {
        if (std::holds_alternative<TwoSidedBsdf>(descriptions[i].model)) continue;
        std::visit(
            [&](const auto& model) {
                if constexpr (!std::is_same_v<std::decay_t<decltype(model)>, TwoSidedBsdf>) bsdfs[i] = flatten(model);
            },
            descriptions[i].model);
    }
    for (std::size_t i = 0; i < descriptions.size(); i++) {
        if (const auto* sides = std::get_if<TwoSidedBsdf>(&descriptions[i].model)) {
            bsdfs[i] = bsdfs.at(sides->front);
            bsdfs[i].flags |= BSDF_TWO_SIDED;
            bsdfs[i].back = sides->back;
        }
    }
    return bsdfs;
}

struct ShapeFlattener {
    FlatScene& flat;
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
        const uint index = static_cast<uint>(flat.shapes.size());
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
        primitive.shape = static_cast<uint>(flat.shapes.size());
        flat.analytics.push_back(primitive);
    }
};

} // namespace

FlatScene flatten_scene(const Scene& scene)
{
    FlatScene flat;
    flat.bsdfs = flatten_bsdfs(scene.bsdfs);
    for (const auto& description : scene.shapes) {
        Shape shape{description.bsdf, NO_LIGHT, 0, 0};
        std::visit(ShapeFlattener{flat, shape}, description.geometry);
        flat.shapes.push_back(shape);
    }
    if (!flat.normals.empty()) flat.normals.resize(flat.positions.size(), Vec3{});

    const Bounds bounds = scene.bounds();
    flat.globals.center = bounds.center();
    // A little more than the half diagonal, so that rays from the sphere start outside of everything.
    flat.globals.radius = std::max(bounds.radius() * 1.001f, 1e-20f);
    list_lights(scene, flat);
    return flat;
}

Camera make_camera(const Sensor& sensor, const Film& film)
{
    Camera camera{};
    camera.position = sensor.position;
    camera.axis_x = sensor.axis_x;
    camera.axis_y = sensor.axis_y;
    camera.axis_z = sensor.axis_z;
    camera.tan_half_x = std::tan(0.5f * sensor.fov_x);
    camera.tan_half_y = camera.tan_half_x * static_cast<float>(film.height) / static_cast<float>(film.width);
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
