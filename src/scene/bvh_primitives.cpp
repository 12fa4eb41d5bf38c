#include "scene/bvh_primitives.h"

#include "base/errors.h"
#include "shared/ray.h"

#include <array>
#include <cfloat>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sundog
{
namespace
{

using Point = std::array<double, 3>;

constexpr double largest_coordinate = 1e12;

Point to_point(Vec3 v)
{
    return {v.x, v.y, v.z};
}

float round_down(double x)
{
    const float rounded = static_cast<float>(x);
    return rounded > x ? std::nextafter(rounded, -INFINITY) : rounded;
}

float round_up(double x)
{
    const float rounded = static_cast<float>(x);
    return rounded < x ? std::nextafter(rounded, INFINITY) : rounded;
}

Bounds round_outwards(const Point& lower, const Point& upper)
{
    return {{round_down(lower[0]), round_down(lower[1]), round_down(lower[2])},
            {round_up(upper[0]), round_up(upper[1]), round_up(upper[2])}};
}

void set_component(Vec3& v, int axis, float value)
{
    (axis == 0 ? v.x : axis == 1 ? v.y : v.z) = value;
}

Vec3 absolute(Vec3 v)
{
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

// Where the edge crosses the plane x[axis] = position, within rounding: thirteen roundings at most of numbers no larger
// than the end points' coordinates.
Bounds crossing(Vec3 from, Vec3 to, int axis, float position)
{
    const float before = component(from, axis) - position, after = component(to, axis) - position;
    const Vec3 point = from + before / (before - after) * (to - from);
    const Vec3 error = 0x1p-20f * max(absolute(from), absolute(to));
    Bounds bounds{point - error, point + error};
    set_component(bounds.lower, axis, position);
    set_component(bounds.upper, axis, position);
    return bounds;
}

// The part of `bounds` inside `box`; all of the box where rounding leaves nothing.
Bounds within(const Bounds& bounds, const Bounds& box)
{
    const Bounds common{max(bounds.lower, box.lower), min(bounds.upper, box.upper)};
    const bool valid = common.lower.x <= common.upper.x && common.lower.y <= common.upper.y && common.lower.z <= common.upper.z;
    return valid ? common : box;
}

// A normal that single precision can hold.
bool has_area(Vec3 a, Vec3 b, Vec3 c)
{
    const Point p = to_point(a), q = to_point(b), r = to_point(c);
    double squared = 0.0;
    for (int i = 0, j = 1, k = 2; i < 3; i++, j = (j + 1) % 3, k = (k + 1) % 3) {
        const double normal = (q[j] - p[j]) * (r[k] - p[k]) - (q[k] - p[k]) * (r[j] - p[j]);
        squared += normal * normal;
    }
    return squared > FLT_MIN;
}

bool in_range(Vec3 v)
{
    // Written so that a NaN is out of range.
    return std::abs(v.x) <= largest_coordinate && std::abs(v.y) <= largest_coordinate && std::abs(v.z) <= largest_coordinate;
}

[[noreturn]] void throw_out_of_range(const char* kind, std::size_t index)
{
    throw SceneError({}, std::string(kind) + " " + std::to_string(index) +
                             " has a coordinate that is not finite or beyond 1e12; check the mesh and its transform");
}

const char* kind_name(const AnalyticPrimitive& primitive)
{
    return primitive.kind == ANALYTIC_SPHERE ? "sphere" : primitive.kind == ANALYTIC_DISK ? "disk" : "cylinder";
}

Bounds bounds_of(const AnalyticPrimitive& primitive)
{
    Point extent, center = to_point(primitive.center);
    double largest = 0.0;
    for (int k = 0; k < 3; k++) {
        const double u = component(primitive.axis_u, k), v = component(primitive.axis_v, k);
        extent[k] = primitive.kind == ANALYTIC_SPHERE ? primitive.radius : std::sqrt(u * u + v * v);
        if (primitive.kind == ANALYTIC_CYLINDER) {
            const double half = 0.5 * static_cast<double>(primitive.length) * component(primitive.normal, k);
            center[k] += half;
            extent[k] = extent[k] * primitive.radius + std::abs(half);
        }
        largest = std::max(largest, extent[k]);
    }
    // Room for the rounding of the device's own test.
    const double room = 1e-6 * largest;
    Point lower, upper;
    for (int k = 0; k < 3; k++) {
        lower[k] = center[k] - extent[k] - room;
        upper[k] = center[k] + extent[k] + room;
    }
    return round_outwards(lower, upper);
}

} // namespace

std::vector<BvhPrimitive> collect_primitives(const BvhGeometry& geometry)
{
    if (geometry.triangles.size() >= ANALYTIC_BIT || geometry.analytics.size() >= ANALYTIC_BIT - 1)
        throw SceneError({}, "the scene has more than 2^31 primitives; use coarser meshes");
    std::vector<BvhPrimitive> primitives;
    primitives.reserve(geometry.triangles.size() + geometry.analytics.size());
    for (std::size_t i = 0; i < geometry.triangles.size(); i++) {
        Bounds bounds;
        std::array<Vec3, 3> vertices;
        for (int k = 0; k < 3; k++) {
            const uint index = geometry.triangles[i].vertex[k];
            if (index >= geometry.positions.size()) throw std::logic_error("triangle " + std::to_string(i) + " refers to a missing vertex");
            vertices[k] = geometry.positions[index];
            if (!in_range(vertices[k])) throw_out_of_range("triangle", i);
            bounds.extend(vertices[k]);
        }
        if (has_area(vertices[0], vertices[1], vertices[2])) primitives.push_back({bounds, static_cast<uint>(i)});
    }
    for (std::size_t i = 0; i < geometry.analytics.size(); i++) {
        const AnalyticPrimitive& primitive = geometry.analytics[i];
        const Bounds bounds = bounds_of(primitive);
        if (!in_range(bounds.lower) || !in_range(bounds.upper))
            throw_out_of_range(kind_name(primitive), i);
        primitives.push_back({bounds, static_cast<uint>(i) | ANALYTIC_BIT});
    }
    return primitives;
}

SplitBounds split_bounds(const BvhGeometry& geometry, uint id, const Bounds& box, int axis, float position)
{
    SplitBounds halves{box, box};
    set_component(halves.below.upper, axis, position);
    set_component(halves.above.lower, axis, position);
    if (id & ANALYTIC_BIT) return halves;
    Bounds below, above;
    const Triangle& triangle = geometry.triangles[id];
    Vec3 from = geometry.positions[triangle.vertex[2]];
    for (uint vertex : triangle.vertex) {
        const Vec3 to = geometry.positions[vertex];
        const float start = component(from, axis), end = component(to, axis);
        if (end <= position) below.extend(to);
        if (end >= position) above.extend(to);
        if ((start < position && end > position) || (start > position && end < position)) {
            const Bounds cut = crossing(from, to, axis, position);
            below.extend(cut);
            above.extend(cut);
        }
        from = to;
    }
    return {within(below, halves.below), within(above, halves.above)};
}

} // namespace sundog
