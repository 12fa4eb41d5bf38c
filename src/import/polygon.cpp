#include "import/polygon.h"

#include <cmath>

namespace sundog
{

namespace
{

struct Point2 {
    double x, y;
};

// Twice the signed area: positive where a, b, c turn counter-clockwise.
double turn(Point2 a, Point2 b, Point2 c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The corners seen along the axis that the polygon's normal (by Newell's method) is closest to, counter-clockwise.
std::vector<Point2> projected(const std::vector<Vec3>& positions, std::span<const uint> polygon)
{
    std::array<double, 3> normal{0, 0, 0};
    const Vec3 origin = positions[polygon[0]];
    const auto offset = [&](std::size_t i) {
        const Vec3 p = positions[polygon[i % polygon.size()]];
        return std::array<double, 3>{static_cast<double>(p.x) - origin.x, static_cast<double>(p.y) - origin.y,
                                     static_cast<double>(p.z) - origin.z};
    };
    for (std::size_t i = 0; i < polygon.size(); i++) {
        const auto a = offset(i), b = offset(i + 1);
        for (std::size_t k = 0; k < 3; k++) {
            const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
            normal[k] += a[l] * b[m] - a[m] * b[l];
        }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; k++)
        if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    std::vector<Point2> points;
    for (std::size_t i = 0; i < polygon.size(); i++) {
        const auto p = offset(i);
        const double x = p[(axis + 1) % 3], y = p[(axis + 2) % 3];
        points.push_back(normal[axis] < 0.0 ? Point2{y, x} : Point2{x, y});
    }
    return points;
}

bool is_convex(const std::vector<Point2>& points)
{
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; i++)
        if (turn(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0.0) return false;
    return true;
}

class EarClipper
{
public:
    explicit EarClipper(const std::vector<Point2>& points) : points_(points)
    {
        for (std::size_t i = 0; i < points.size(); i++) left_.push_back(i);
    }

    // Corner numbers of the next triangle.
    std::array<std::size_t, 3> clip()
    {
        // A polygon without self-intersections has an ear; of others any corner will do.
        std::size_t ear = 0;
        while (ear < left_.size() && !is_ear(ear)) ear++;
        if (ear == left_.size()) ear = 0;
        const std::array<std::size_t, 3> triangle = around(ear);
        left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
        return triangle;
    }

    std::size_t corners_left() const { return left_.size(); }

private:
    std::array<std::size_t, 3> around(std::size_t i) const
    {
        const std::size_t n = left_.size();
        return {left_[(i + n - 1) % n], left_[i], left_[(i + 1) % n]};
    }

    bool is_ear(std::size_t i) const
    {
        const auto [a, b, c] = around(i);
        const Point2 p = points_[a], q = points_[b], r = points_[c];
        if (!(turn(p, q, r) > 0.0)) return false;
        for (std::size_t other : left_) {
            if (other == a || other == b || other == c) continue;
            const Point2 s = points_[other];
            if (turn(p, q, s) >= 0.0 && turn(q, r, s) >= 0.0 && turn(r, p, s) >= 0.0) return false;
        }
        return true;
    }

    const std::vector<Point2>& points_;
    std::vector<std::size_t> left_;
};

} // namespace

bool append_polygon(const std::vector<Vec3>& positions, std::span<const uint> polygon, std::vector<std::array<uint, 3>>& triangles)
{
    if (polygon.size() == 3) {
        triangles.push_back({polygon[0], polygon[1], polygon[2]});
        return true;
    }
    const std::vector<Point2> points = projected(positions, polygon);
    if (is_convex(points)) {
        for (std::size_t i = 1; i + 1 < polygon.size(); i++) triangles.push_back({polygon[0], polygon[i], polygon[i + 1]});
        return true;
    }
    if (polygon.size() > max_concave_corners) return false;
    EarClipper clipper(points);
    while (clipper.corners_left() >= 3) {
        const auto [a, b, c] = clipper.clip();
        triangles.push_back({polygon[a], polygon[b], polygon[c]});
    }
    return true;
}

} // namespace sundog
