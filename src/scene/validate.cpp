#include "scene/validate.h"

#include "scene/check_places.h"
#include "scene/flatten_environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace sundog
{

namespace
{

constexpr std::size_t max_primitives = std::size_t{1} << 30; // room for ANALYTIC_BIT and three vertices each

double area_of(const TriangleMesh& mesh)
{
    double sum = 0.0;
    for (const auto& t : mesh.triangles) {
        const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        const double ux = static_cast<double>(b.x) - a.x, uy = static_cast<double>(b.y) - a.y, uz = static_cast<double>(b.z) - a.z;
        const double vx = static_cast<double>(c.x) - a.x, vy = static_cast<double>(c.y) - a.y, vz = static_cast<double>(c.z) - a.z;
        sum += 0.5 * std::hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
    }
    return sum;
}

double area_of(const Sphere& sphere)
{
    return 4.0 * std::numbers::pi * sphere.radius * sphere.radius;
}

double area_of(const Disk& disk)
{
    return std::numbers::pi * static_cast<double>(length(cross(disk.axis_u, disk.axis_v)));
}

double area_of(const Cylinder& cylinder)
{
    return 2.0 * std::numbers::pi * cylinder.radius * cylinder.length;
}

Vec3 emission_of(const EmitterDescription& emitter)
{
    struct Emission {
        Vec3 operator()(const PointEmitter& e) const { return e.intensity; }
        Vec3 operator()(const SpotEmitter& e) const { return e.intensity; }
        Vec3 operator()(const DirectionalEmitter& e) const { return e.irradiance; }
        Vec3 operator()(const CollimatedEmitter& e) const { return e.power; }
        Vec3 operator()(const ConstantEmitter& e) const { return e.radiance; }
        Vec3 operator()(const ProjectorEmitter& e) const { return e.irradiance; }
        Vec3 operator()(const EnvironmentEmitter& e) const { return Vec3{1, 1, 1} * static_cast<float>(e.scale * mean_luminance(e)); }
        Vec3 operator()(const SunSkyEmitter& e) const { return Vec3{1, 1, 1} * std::max(e.sky_scale, e.sun_scale); }
    };
    return std::visit(Emission{}, emitter.model);
}

bool surrounds(const EmitterDescription& emitter)
{
    return std::holds_alternative<ConstantEmitter>(emitter.model) || std::holds_alternative<EnvironmentEmitter>(emitter.model) ||
           std::holds_alternative<SunSkyEmitter>(emitter.model);
}

constexpr const char* dark = "a light that emits nothing is left out";
constexpr double most_emission = 1e30; // radiance, intensity, power, ...: sums and products of it stay finite

void check_emission(double emission, const SourceLocation& where)
{
    if (!(emission <= most_emission)) throw SceneError(where, "the light is too bright for 32-bit numbers: give it at most 1e30");
}

// The one that gives no light, and why.
struct DarkLight {
    SourceLocation where;
    bool is_image = false;
};

void check_area_lights(Scene& scene, std::vector<Warning>& warnings, std::optional<DarkLight>& first_dark)
{
    for (auto& shape : scene.shapes) {
        if (!shape.emitter) continue;
        if (max_component(shape.emitter->radiance) <= 0.0f) {
            warnings.push_back(shape.where.prefix() + dark);
            if (!first_dark) first_dark = {shape.where};
            shape.emitter.reset();
            continue;
        }
        const auto area = static_cast<float>(surface_area(shape));
        if (!(area > 0.0f)) throw SceneError(shape.where, "the area of the light is zero in 32-bit numbers: scale the scene up");
        if (!std::isfinite(area))
            throw SceneError(shape.where, "the area of the light is too large for 32-bit numbers: scale the scene down");
        const double radiance = max_component(shape.emitter->radiance);
        check_emission(radiance * std::max(1.0, std::numbers::pi * area), shape.where);
    }
}

void check_emitters(Scene& scene, std::vector<Warning>& warnings, std::optional<DarkLight>& first_dark)
{
    bool environment = false;
    for (std::size_t i = 0; i < scene.emitters.size();) {
        const auto& emitter = scene.emitters[i];
        if (surrounds(emitter)) {
            if (environment) throw SceneError(emitter.where, "the scene has two environments: keep one constant, envmap, sky, sun or sunsky emitter");
            environment = true;
        }
        const float emission = max_component(emission_of(emitter));
        if (!(emission <= 0.0f)) {
            check_emission(emission, emitter.where);
            i++;
            continue;
        }
        warnings.push_back(emitter.where.prefix() + dark);
        if (!first_dark) first_dark = {emitter.where, std::holds_alternative<EnvironmentEmitter>(emitter.model)};
        scene.emitters.erase(scene.emitters.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

} // namespace

double surface_area(const ShapeDescription& shape)
{
    return std::visit([](const auto& geometry) { return area_of(geometry); }, shape.geometry);
}

void validate_scene(Scene& scene, std::vector<Warning>& warnings)
{
    if (scene.triangle_count() > max_primitives)
        throw SceneError({scene.file, 0},
                         "the scene has " + std::to_string(scene.triangle_count()) + " triangles; at most 2^30 can be rendered");
    check_places(scene);
    std::optional<DarkLight> dark_light;
    check_area_lights(scene, warnings, dark_light);
    check_emitters(scene, warnings, dark_light);
    bool lit = !scene.emitters.empty();
    for (const auto& shape : scene.shapes) lit = lit || shape.emitter.has_value();
    if (scene.shapes.empty() && lit)
        warnings.push_back(Warning(SourceLocation{scene.file, 0}.prefix() + "the scene has no <shape>: it shows the environment at most"));
    if (!lit && dark_light)
        throw SceneError(dark_light->where, std::string("the scene has no light: this one emits nothing") +
                                                (dark_light->is_image ? ", for its image (or its scale) is nowhere above 0; negative values and NaN count as 0" : "") +
                                                ". Give it values above 0");
    if (!lit) throw SceneError({scene.file, 0}, "the scene has no light: add an <emitter> with a radiance or intensity above 0");
}

} // namespace sundog
