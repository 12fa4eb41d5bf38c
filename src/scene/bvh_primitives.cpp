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

// Box of points that are given in double precision.
struct PointBounds {
    Point lower{INFINITY, INFINITY, INFINITY};
    Point upper{-INFINITY, -INFINITY, -INFINITY};

    void extend(const Point& p)
    {
        for (int k = 0; k < 3; k++) {
            lower[k] = std::min(lower[k], p[k]);
            upper[k] = std::max(upper[k], p[k]);
        }
    }
};

// The part of `bounds` inside `box`; all of the box where rounding leaves nothing.
Bounds within(const PointBounds& bounds, const Bounds& box)
{
    const Bounds rounded = round_outwards(bounds.lower, bounds.upper);
    const Bounds common{max(rounded.lower, box.lower), min(rounded.upper, box.upper)};
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

Bounds bounds_of(const AnalyticPrimitive& primitive)
{
    Point extent;
    for (int k = 0; k < 3; k++) {
        const double u = component(primitive.axis_u, k), v = component(primitive.axis_v, k);
        extent[k] = primitive.kind == ANALYTIC_SPHERE ? primitive.radius : std::sqrt(u * u + v * v);
    }
    // Room for the rounding of the device's own test.
    const double room = 1e-6 * std::max(extent[0], std::max(extent[1], extent[2]));
    const Point center = to_point(primitive.center);
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
            throw_out_of_range(primitive.kind == ANALYTIC_SPHERE ? "sphere" : "disk", i);
        primitives.push_back({bounds, static_cast<uint>(i) | ANALYTIC_BIT});
    }
    return primitives;
}

SplitBounds split_bounds(const BvhGeometry& geometry, uint id, const Bounds& box, int axis, float position)
{
    SplitBounds boxes{box, box};
    (&boxes.below.upper.x)[axis] = position;
    (&boxes.above.lower.x)[axis] = position;
    if (id & ANALYTIC_BIT) return boxes;
    PointBounds below, above;
    const Triangle& triangle = geometry.triangles[id];
    for (int k = 0; k < 3; k++) {
        const Point from = to_point(geometry.positions[triangle.vertex[k]]);
        const Point to = to_point(geometry.positions[triangle.vertex[(k + 1) % 3]]);
        const double before = from[axis] - position, after = to[axis] - position;
        if (before <= 0.0) below.extend(from);
        if (before >= 0.0) above.extend(from);
        if (before * after < 0.0) { // the edge crosses the plane
            Point crossing;
            for (int j = 0; j < 3; j++) crossing[j] = from[j] + before / (before - after) * (to[j] - from[j]);
            crossing[axis] = position;
            below.extend(crossing);
            above.extend(crossing);
        }
    }
    return {within(below, boxes.below), within(above, boxes.above)};
}

} // namespace sundog
