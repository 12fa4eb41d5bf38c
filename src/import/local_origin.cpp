#include "import/local_origin.h"

#include "import/number_text.h"

#include <algorithm>
#include <cmath>

namespace sundog
{

namespace
{

double distance(Vec3 v)
{
    return std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
}

Double3 rounded(Vec3 center, double radius)
{
    const double step = radius > 0.0 ? std::exp2(std::ceil(std::log2(radius))) : 0.0;
    Double3 r{center.x, center.y, center.z};
    if (step > 0.0)
        for (double& c : r) c = step * std::round(c / step);
    return r;
}

LocalOrigin moved(const LocalOrigin& origin, const Bounds& bounds)
{
    const Double3 offset = rounded(bounds.center(), bounds.radius());
    LocalOrigin result = origin;
    for (std::size_t i = 0; i < 3; i++) result.place[i] += offset[i];
    result.radius = bounds.radius();
    return result;
}

// Of groups in their own spaces; empty for one with an instance that moves, which has to turn about the origin of the file.
std::vector<Bounds> bounds_of_groups(const Scene& scene)
{
    std::vector<Bounds> groups(scene.groups.size());
    for (const ShapeDescription& shape : scene.shapes)
        if (shape.group) groups[*shape.group].extend(shape.bounds());
    for (const InstanceDescription& instance : scene.instances)
        if (!instance.to_world.is_constant()) groups[instance.group] = Bounds();
    return groups;
}

// Steps of 32-bit numbers at the shape's place, over its size.
double coarseness(const Bounds& bounds)
{
    const Vec3 largest = max(bounds.upper, -bounds.lower);
    return static_cast<double>(max_component(largest)) * 0x1p-23 / (2.0 * bounds.radius());
}

} // namespace

LocalOrigin LocalOrigins::of(std::optional<uint> group) const
{
    if (!group) return world;
    const auto found = groups.find(*group);
    return found == groups.end() ? LocalOrigin() : found->second;
}

bool is_far(const Bounds& bounds)
{
    return !bounds.empty() && distance(bounds.center()) > far_in_radii * bounds.radius();
}

std::optional<LocalOrigins> nearer_origins(const LocalOrigins& origins, const Scene& scene)
{
    LocalOrigins nearer = origins;
    bool any = false;
    if (const Bounds bounds = scene.bounds(); is_far(bounds)) {
        nearer.world = moved(origins.world, bounds);
        any = true;
    }
    const std::vector<Bounds> groups = bounds_of_groups(scene);
    for (uint i = 0; i < groups.size(); i++) {
        if (!is_far(groups[i])) continue;
        nearer.groups[i] = moved(origins.of(i), groups[i]);
        any = true;
    }
    if (!any) return {};
    return nearer;
}

LocalOrigins nearer_origins(const LocalOrigins& origins, const LostFarAway& lost)
{
    LocalOrigins nearer = origins;
    nearer.world = moved(origins.world, {lost.center, lost.center});
    return nearer;
}

void warn_of_places(const Scene& scene, std::vector<Warning>& warnings)
{
    if (scene.origin != Double3{0, 0, 0})
        warnings.emplace_back(SourceLocation{scene.file, 0}.prefix() + "the scene is far from the origin: its places are counted from (" +
                              number_text(scene.origin[0]) + ", " + number_text(scene.origin[1]) + ", " + number_text(scene.origin[2]) +
                              ")");
    constexpr double visible = 1e-3;
    std::size_t coarse = 0;
    const ShapeDescription* worst = nullptr;
    for (const ShapeDescription& shape : scene.shapes) {
        if (!(coarseness(shape.bounds()) > visible)) continue;
        coarse++;
        if (!worst || coarseness(shape.bounds()) > coarseness(worst->bounds())) worst = &shape;
    }
    if (!worst) return;
    const Bounds bounds = worst->bounds();
    warnings.emplace_back(worst->where.prefix() + (coarse > 1 ? std::to_string(coarse) + " shapes are" : "a shape is") +
                              " coarse: the worst is " + rounded_text(2.0 * bounds.radius()) + " large and " +
                              rounded_text(distance(bounds.center())) +
                              " from the middle of the scene, where 32-bit numbers are in steps of " +
                              rounded_text(coarseness(bounds) * 2.0 * bounds.radius()) + ": put it nearer, or make it larger",
                          WarningKind::approximated);
}

} // namespace sundog
