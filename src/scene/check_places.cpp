#include "scene/check_places.h"

#include "math/double3.h"
#include "scene/scene.h"

#include <cfloat>
#include <set>

namespace sundog
{

namespace
{

constexpr float largest_coordinate = 1e12f; // as in build_bvh
constexpr float smallest_size = 1e-12f;     // whose square and its inverse are still far inside the range

bool in_range(Vec3 v)
{
    // Written so that a NaN is out of range.
    return std::abs(v.x) <= largest_coordinate && std::abs(v.y) <= largest_coordinate && std::abs(v.z) <= largest_coordinate;
}

void require_in_range(const Bounds& bounds, const SourceLocation& where, const char* what)
{
    if (!bounds.empty() && in_range(bounds.lower) && in_range(bounds.upper)) return;
    throw SceneError(where, std::string("the ") + what +
                                " has a coordinate that is not finite or beyond 1e12: check its transform and the unit of length");
}

// Whether single precision can hold the normal, so that the hierarchy takes the triangle.
bool has_area(const TriangleMesh& mesh, const std::array<uint, 3>& t)
{
    const Double3 n = cross(difference(mesh.positions[t[1]], mesh.positions[t[0]]), difference(mesh.positions[t[2]], mesh.positions[t[0]]));
    return dot(n, n) > FLT_MIN;
}

struct IsTooSmall {
    bool operator()(const TriangleMesh& mesh) const
    {
        return std::none_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) { return has_area(mesh, t); });
    }
    bool operator()(const Sphere& sphere) const { return sphere.radius < smallest_size; }
    bool operator()(const Disk& disk) const { return std::min(length(disk.axis_u), length(disk.axis_v)) < smallest_size; }
    bool operator()(const Cylinder& cylinder) const { return std::min(cylinder.radius, cylinder.length) < smallest_size; }
};

struct PlaceOfEmitter {
    template <class T> std::optional<Vec3> operator()(const T& emitter) const
    {
        if constexpr (requires { emitter.position; }) return emitter.position;
        return {};
    }
};

void check_attributes(const ShapeDescription& shape, const std::set<std::string>& shown)
{
    const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
    if (!mesh || shown.empty()) return;
    for (const MeshAttribute& attribute : mesh->attributes) {
        if (!shown.contains(attribute.name)) continue;
        for (std::size_t i = 0; i < attribute.values.size(); i++)
            if (!is_finite(attribute.values[i]))
                throw SceneError(shape.where, "value " + std::to_string(i + 1) + " of the mesh attribute '" + attribute.name +
                                                  "' is not finite: repair the mesh, or the texture that shows it");
    }
}

} // namespace

void check_places(const Scene& scene)
{
    std::set<std::string> shown;
    for (const TextureDescription& texture : scene.textures)
        if (const auto* attribute = std::get_if<AttributeTexture>(&texture.model)) shown.insert(attribute->name);
    std::vector<Bounds> groups(scene.groups.size());
    for (const ShapeDescription& shape : scene.shapes) {
        const Bounds bounds = shape.bounds();
        require_in_range(bounds, shape.where, "shape");
        if (shape.group) groups[*shape.group].extend(bounds);
        if (std::visit(IsTooSmall{}, shape.geometry))
            throw SceneError(shape.where, "the shape is too small for 32-bit numbers: scale the scene up");
        check_attributes(shape, shown);
    }
    for (const InstanceDescription& instance : scene.instances) {
        const auto [open, close] = scene.sensor.shutter;
        if (const Bounds& group = groups[instance.group]; !group.empty())
            require_in_range(instance.to_world.box(group, open, close), instance.where, "instance");
    }
    for (const EmitterDescription& emitter : scene.emitters)
        if (const auto place = std::visit(PlaceOfEmitter{}, emitter.model)) require_in_range({*place, *place}, emitter.where, "light");
    require_in_range({scene.sensor.position, scene.sensor.position}, scene.sensor.where, "sensor");
}

} // namespace sundog
