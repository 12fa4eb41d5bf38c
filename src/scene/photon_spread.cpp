#include "scene/photon_spread.h"

#include "scene/flat_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sundog
{

namespace
{

constexpr int rays_across = 16;
// Of surfaces that are seen along themselves, whose pixels would show half of the world.
constexpr double least_cosine = 0.05;
constexpr double fewest = 1e-3;

struct Line {
    Vec3 origin, direction; // unit length
};

// Where a line first meets something, at a distance t along it.
struct FirstSurface {
    double t = std::numeric_limits<double>::infinity();
    Vec3 normal; // of any length

    void meet(double other, Vec3 other_normal)
    {
        if (!(other > 0.0) || !(other < t)) return;
        t = other;
        normal = other_normal;
    }
};

bool may_meet(const Line& line, const Bounds& box, double nearest)
{
    double first = 0.0, last = nearest;
    const auto cut = [&](float origin, float direction, float lower, float upper) {
        const double a = (double(lower) - double(origin)) / double(direction), b = (double(upper) - double(origin)) / double(direction);
        if (std::isnan(a) || std::isnan(b)) return; // within a side
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    };
    cut(line.origin.x, line.direction.x, box.lower.x, box.upper.x);
    cut(line.origin.y, line.direction.y, box.lower.y, box.upper.y);
    cut(line.origin.z, line.direction.z, box.lower.z, box.upper.z);
    return first <= last;
}

// Where a x^2 + 2 b x + c is 0.
void meet_roots(double a, double b, double c, const auto& meet)
{
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0.0) || a == 0.0) return;
    meet((-b - std::sqrt(discriminant)) / a);
    meet((-b + std::sqrt(discriminant)) / a);
}

void trace(const Line& line, const TriangleMesh& mesh, FirstSurface& found)
{
    Bounds box;
    for (const Vec3 p : mesh.positions) box.extend(p);
    if (!may_meet(line, box, found.t)) return;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 a = mesh.positions[i], u = mesh.positions[j] - a, v = mesh.positions[k] - a;
        const Vec3 p = cross(line.direction, v), s = line.origin - a, q = cross(s, u);
        const double determinant = double(dot(u, p)), x = double(dot(s, p)) / determinant, y = double(dot(line.direction, q)) / determinant;
        if (x >= 0.0 && y >= 0.0 && x + y <= 1.0) found.meet(double(dot(v, q)) / determinant, cross(u, v));
    }
}

void trace(const Line& line, const Sphere& sphere, FirstSurface& found)
{
    const Vec3 offset = line.origin - sphere.center;
    meet_roots(1.0, double(dot(offset, line.direction)), double(dot(offset, offset)) - double(sphere.radius) * double(sphere.radius),
               [&](double t) { found.meet(t, offset + line.direction * static_cast<float>(t)); });
}

void trace(const Line& line, const Disk& disk, FirstSurface& found)
{
    const Vec3 n = disk.normal(), offset = disk.center - line.origin;
    const double t = double(dot(offset, n)) / double(dot(line.direction, n));
    const Vec3 at = line.direction * static_cast<float>(t) - offset;
    const double a = double(dot(at, disk.axis_u)) / double(dot(disk.axis_u, disk.axis_u));
    const double b = double(dot(at, disk.axis_v)) / double(dot(disk.axis_v, disk.axis_v));
    if (a * a + b * b <= 1.0) found.meet(t, n);
}

void trace(const Line& line, const Cylinder& cylinder, FirstSurface& found)
{
    const Vec3 offset = line.origin - cylinder.start, axis = cylinder.axis_z;
    const Vec3 across = line.direction - axis * dot(line.direction, axis), from = offset - axis * dot(offset, axis);
    meet_roots(double(dot(across, across)), double(dot(from, across)), double(dot(from, from)) - double(cylinder.radius) * double(cylinder.radius),
               [&](double t) {
                   const float along = dot(offset + line.direction * static_cast<float>(t), axis);
                   if (along >= 0.0f && along <= cylinder.length) found.meet(t, from + across * static_cast<float>(t));
               });
}

FirstSurface first_surface(const Scene& scene, const Line& line)
{
    FirstSurface found;
    for (const ShapeDescription& shape : scene.shapes)
        if (!shape.group) std::visit([&](const auto& geometry) { trace(line, geometry, found); }, shape.geometry);
    return found;
}

struct CameraLine {
    Line line;
    double pixel_area; // across the line, at distance 1 from a perspective camera; an orthographic one's at any
};

CameraLine camera_line(const Camera& camera, double x, double y)
{
    const double sx = camera.half_width * (1.0 - 2.0 * x), sy = camera.half_height * (1.0 - 2.0 * y);
    const Vec3 offset = camera.axis_x * static_cast<float>(sx + double(camera.shift_x)) + camera.axis_y * static_cast<float>(sy + double(camera.shift_y));
    const double area = 4.0 * double(camera.half_width) * double(camera.half_height) / (double(camera.film_width) * double(camera.film_height));
    if (camera.kind == CAMERA_ORTHOGRAPHIC) return {{camera.position + offset, camera.axis_z}, area};
    const Vec3 direction = camera.axis_z + offset;
    const double stretch = double(length(direction));
    return {{camera.position, direction / static_cast<float>(stretch)}, area / (stretch * stretch * stretch)};
}

// Areas of surface that pixels of a grid over the image show, least first.
std::vector<double> areas_seen(const Scene& scene, const Camera& camera)
{
    std::vector<double> areas;
    for (int j = 0; j < rays_across; j++)
        for (int i = 0; i < rays_across; i++) {
            const auto place = [](int index, int crop, int size, int film) { return (crop + (index + 0.5) / rays_across * size) / film; };
            const auto [line, pixel_area] = camera_line(camera, place(i, camera.crop_x, camera.crop_width, camera.film_width),
                                                        place(j, camera.crop_y, camera.crop_height, camera.film_height));
            const FirstSurface seen = first_surface(scene, line);
            if (!std::isfinite(seen.t)) continue;
            const double cosine = std::abs(double(dot(seen.normal, line.direction))) / double(length(seen.normal));
            const double distance = camera.kind == CAMERA_ORTHOGRAPHIC ? 1.0 : seen.t;
            areas.push_back(pixel_area * distance * distance / std::max(cosine, least_cosine));
        }
    std::sort(areas.begin(), areas.end());
    return areas;
}

bool is_distant(const EmitterDescription& emitter)
{
    return std::holds_alternative<DirectionalEmitter>(emitter.model) || std::holds_alternative<ConstantEmitter>(emitter.model) ||
           std::holds_alternative<EnvironmentEmitter>(emitter.model);
}

Bounds bounds_of(const ShapeDescription& shape)
{
    Scene alone;
    alone.shapes = {shape};
    return alone.bounds();
}

const ShapeDescription& largest_shape(const Scene& scene)
{
    const auto size = [](const ShapeDescription& shape) { return shape.group ? 0.0f : bounds_of(shape).radius(); };
    return *std::max_element(scene.shapes.begin(), scene.shapes.end(), [&](const auto& a, const auto& b) { return size(a) < size(b); });
}

} // namespace

std::optional<double> share_of_distant_photons(const Scene& scene)
{
    if (scene.shapes.empty() || !std::any_of(scene.emitters.begin(), scene.emitters.end(), is_distant)) return {};
    const Camera camera = make_camera(scene.sensor, scene.film);
    const std::vector<double> areas = areas_seen(scene, camera);
    const double radius = double(scene.bounds().radius());
    if (areas.size() < rays_across || !(radius > 0.0)) return {};
    double sum = 0.0;
    for (std::size_t i = 0; i < areas.size() / 2; i++) sum += areas[i];
    const double pixels = double(camera.crop_width) * double(camera.crop_height) / (rays_across * rays_across);
    return std::min(1.0, sum * pixels / (std::numbers::pi * radius * radius));
}

std::optional<std::string> warn_of_spread_photons(const Scene& scene)
{
    const std::optional<double> share = share_of_distant_photons(scene);
    if (!share || *share >= fewest) return {};
    const ShapeDescription& largest = largest_shape(scene);
    return fmt::format("{}photons of distant lights (sun, sky) are spread over the whole scene, a disk of radius {:.4g}, and half of the image "
                       "shows 1/{:.0f} of it: fewer than one photon in a thousand is used, so caustics will be dark or missing; make what "
                       "is far off smaller (this shape has a radius of {:.4g}), or trace more photons (-p photons=N)",
                       largest.where.prefix(), scene.bounds().radius(), 1.0 / *share, bounds_of(largest).radius());
}

} // namespace sundog
