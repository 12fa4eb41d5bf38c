#include "scene/validate.h"

#include "scene/check_places.h"
#include "scene/flatten_environment.h"

#include <cmath>
#include <numbers>

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
    };
    return std::visit(Emission{}, emitter.model);
}

constexpr const char* dark = "a light that emits nothing is left out";

void check_area_lights(Scene& scene, std::vector<Warning>& warnings)
{
    for (auto& shape : scene.shapes) {
        if (!shape.emitter) continue;
        if (max_component(shape.emitter->radiance) <= 0.0f) {
            warnings.push_back(shape.where.prefix() + dark);
            shape.emitter.reset();
            continue;
        }
        const auto area = static_cast<float>(surface_area(shape));
        if (!(area > 0.0f)) throw SceneError(shape.where, "the area of the light is zero in 32-bit numbers: scale the scene up");
        if (!std::isfinite(area))
            throw SceneError(shape.where, "the area of the light is too large for 32-bit numbers: scale the scene down");
    }
}

void check_emitters(Scene& scene, std::vector<Warning>& warnings)
{
    bool environment = false;
    for (std::size_t i = 0; i < scene.emitters.size();) {
        const auto& emitter = scene.emitters[i];
        if (std::holds_alternative<ConstantEmitter>(emitter.model) || std::holds_alternative<EnvironmentEmitter>(emitter.model)) {
            if (environment) throw SceneError(emitter.where, "the scene has two environments: keep one constant or envmap emitter");
            environment = true;
        }
        if (max_component(emission_of(emitter)) > 0.0f) {
            i++;
            continue;
        }
        warnings.push_back(emitter.where.prefix() + dark);
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
    if (scene.shapes.empty()) throw SceneError({scene.file, 0}, "the scene has no <shape>: there is nothing to render");
    if (scene.triangle_count() > max_primitives)
        throw SceneError({scene.file, 0},
                         "the scene has " + std::to_string(scene.triangle_count()) + " triangles; at most 2^30 can be rendered");
    check_places(scene);
    check_area_lights(scene, warnings);
    check_emitters(scene, warnings);
    bool lit = !scene.emitters.empty();
    for (const auto& shape : scene.shapes) lit = lit || shape.emitter.has_value();
    if (!lit) throw SceneError({scene.file, 0}, "the scene has no light: add an <emitter> with a radiance or intensity above 0");
}

} // namespace sundog
