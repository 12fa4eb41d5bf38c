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

// A convex polygon: a triangle cut by up to six planes has nine corners at most.
struct Polygon {
    std::array<Point, 9> corners;
    int count = 0;

    void add(const Point& p) { corners[count++] = p; }
};

// Sutherland-Hodgman: keeps sign * x[axis] <= sign * position.
Polygon clip(const Polygon& polygon, int axis, double position, double sign)
{
    Polygon kept;
    for (int i = 0; i < polygon.count; i++) {
        const Point& from = polygon.corners[i];
        const Point& to = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
        const double before = sign * (from[axis] - position);
        const double after = sign * (to[axis] - position);
        if (before <= 0.0) kept.add(from);
        if ((before < 0.0 && after > 0.0) || (before > 0.0 && after < 0.0)) {
            const double s = before / (before - after);
            Point crossing;
            for (int k = 0; k < 3; k++) crossing[k] = from[k] + s * (to[k] - from[k]);
            crossing[axis] = position;
            kept.add(crossing);
        }
    }
    return kept;
}

Bounds bounds_of(const Polygon& polygon)
{
    Point lower = polygon.corners[0], upper = polygon.corners[0];
    for (int i = 1; i < polygon.count; i++) {
        for (int k = 0; k < 3; k++) {
            lower[k] = std::min(lower[k], polygon.corners[i][k]);
            upper[k] = std::max(upper[k], polygon.corners[i][k]);
        }
    }
    return round_outwards(lower, upper);
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

Bounds clipped_bounds(const BvhGeometry& geometry, uint id, const Bounds& box)
{
    if (id & ANALYTIC_BIT) return box;
    const Triangle& triangle = geometry.triangles[id];
    Polygon polygon;
    for (uint vertex : triangle.vertex) polygon.add(to_point(geometry.positions[vertex]));
    for (int axis = 0; axis < 3; axis++) {
        polygon = clip(polygon, axis, component(box.lower, axis), -1.0);
        polygon = clip(polygon, axis, component(box.upper, axis), 1.0);
    }
    if (polygon.count == 0) return box; // only touches the box, within rounding
    const Bounds exact = bounds_of(polygon);
    return {max(exact.lower, box.lower), min(exact.upper, box.upper)};
}

} // namespace sundog
