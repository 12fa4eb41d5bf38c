// Double-precision triples: what device results are checked against.
#pragma once

#include "shared/vec3.h"

#include <cmath>

namespace sundog
{

struct Vec3d {
    double x = 0.0, y = 0.0, z = 0.0;

    Vec3d() = default;
    Vec3d(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
    Vec3d(Vec3 v) : x(v.x), y(v.y), z(v.z) {}

    Vec3d operator+(Vec3d b) const { return {x + b.x, y + b.y, z + b.z}; }
    Vec3d operator-(Vec3d b) const { return {x - b.x, y - b.y, z - b.z}; }
    Vec3d operator*(double s) const { return {x * s, y * s, z * s}; }
    Vec3d operator*(Vec3d b) const { return {x * b.x, y * b.y, z * b.z}; } // colours
    Vec3d operator/(double s) const { return {x / s, y / s, z / s}; }
    Vec3d operator-() const { return {-x, -y, -z}; }
};

inline double dot(Vec3d a, Vec3d b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3d cross(Vec3d a, Vec3d b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3d a)
{
    return std::sqrt(dot(a, a));
}
inline double largest(Vec3d a)
{
    return std::fmax(a.x, std::fmax(a.y, a.z));
}
inline bool is_black(Vec3d a)
{
    return a.x == 0.0 && a.y == 0.0 && a.z == 0.0;
}
inline Vec3d normalized(Vec3d a)
{
    return a / length(a);
}
inline Vec3 to_float(Vec3d a)
{
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

// Any orthonormal frame about n.
struct Frame3d {
    Vec3d s, t, n;

    explicit Frame3d(Vec3d normal) : n(normalized(normal))
    {
        s = normalized(cross(std::abs(n.x) > 0.5 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0), n));
        t = cross(n, s);
    }
    Vec3d to_world(Vec3d v) const { return s * v.x + t * v.y + n * v.z; }
    Vec3d to_local(Vec3d v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
};

} // namespace sundog
