#include "math/transform.h"

#include <cmath>
#include <numbers>

namespace sundog
{

namespace
{

Double3 normalized(const Double3& a)
{
    const double scale = 1.0 / std::sqrt(dot(a, a));
    return {a[0] * scale, a[1] * scale, a[2] * scale};
}

Double3 column(const Transform& t, std::size_t j)
{
    return {t.m[0][j], t.m[1][j], t.m[2][j]};
}

Vec3 to_float(const Double3& a)
{
    return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])};
}

// Some direction across `a`: its cross product with the axis that it is least aligned with.
Double3 any_perpendicular(const Double3& a)
{
    std::size_t least = 0;
    for (std::size_t i = 1; i < 3; i++)
        if (std::abs(a[i]) < std::abs(a[least])) least = i;
    Double3 axis{0, 0, 0};
    axis[least] = 1;
    return normalized(cross(a, axis));
}

} // namespace

Transform Transform::translate(Double3 offset)
{
    Transform t;
    for (std::size_t i = 0; i < 3; i++) t.m[i][3] = offset[i];
    return t;
}

Transform Transform::scale(Double3 factors)
{
    Transform t;
    for (std::size_t i = 0; i < 3; i++) t.m[i][i] = factors[i];
    return t;
}

Transform Transform::rotate(Double3 axis, double degrees)
{
    // Rodrigues: R = cos I + sin [a]x + (1 - cos) a a^T. Quarter turns are exact, as scenes are full of them.
    const Double3 a = normalized(axis);
    const double quarters = degrees / 90.0;
    double c = std::cos(degrees * std::numbers::pi / 180.0);
    double s = std::sin(degrees * std::numbers::pi / 180.0);
    if (quarters == std::floor(quarters)) {
        c = std::round(c);
        s = std::round(s);
    }
    const std::array<Double3, 3> skew = {{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}}};
    Transform t;
    for (std::size_t i = 0; i < 3; i++)
        for (std::size_t j = 0; j < 3; j++) t.m[i][j] = (i == j ? c : 0.0) + s * skew[i][j] + (1.0 - c) * a[i] * a[j];
    return t;
}

std::optional<Transform> Transform::look_at(Double3 origin, Double3 target, std::optional<Double3> up)
{
    const Double3 offset{target[0] - origin[0], target[1] - origin[1], target[2] - origin[2]};
    if (!(dot(offset, offset) > 0.0)) return {};
    const Double3 z = normalized(offset);
    const Double3 upward = normalized(up.value_or(any_perpendicular(z)));
    const Double3 across = cross(upward, z);
    if (!(dot(across, across) > 1e-16)) return {};
    const Double3 x = normalized(across);
    const Double3 y = cross(z, x);
    Transform t;
    for (std::size_t i = 0; i < 3; i++) t.m[i] = {x[i], y[i], z[i], origin[i]};
    return t;
}

Vec3 Transform::point(Vec3 p) const
{
    return to_float(exact_point({p.x, p.y, p.z}));
}

Double3 Transform::exact_point(const Double3& p) const
{
    Double3 r;
    for (std::size_t i = 0; i < 3; i++) r[i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2] + m[i][3];
    return r;
}

Vec3 Transform::vector(Vec3 v) const
{
    Double3 r;
    for (std::size_t i = 0; i < 3; i++) r[i] = m[i][0] * v.x + m[i][1] * v.y + m[i][2] * v.z;
    return to_float(r);
}

Vec3 Transform::normal(Vec3 n) const
{
    // Columns of the cofactor matrix, which is det M * M^-T, are cross products of M's columns.
    const Double3 x = column(*this, 0), y = column(*this, 1), z = column(*this, 2);
    const Double3 yz = cross(y, z), zx = cross(z, x), xy = cross(x, y);
    const double sign = determinant() < 0.0 ? -1.0 : 1.0;
    Double3 r;
    for (std::size_t i = 0; i < 3; i++) r[i] = sign * (yz[i] * n.x + zx[i] * n.y + xy[i] * n.z);
    return to_float(normalized(r));
}

Transform Transform::relative_to(const Double3& origin) const
{
    Transform t = *this;
    for (std::size_t i = 0; i < 3; i++) t.m[i][3] -= origin[i];
    return t;
}

Transform Transform::inverse() const
{
    // Rows of the inverse are cross products of columns, over the determinant.
    const Double3 x = column(*this, 0), y = column(*this, 1), z = column(*this, 2);
    const std::array<Double3, 3> rows = {cross(y, z), cross(z, x), cross(x, y)};
    const double scale = 1.0 / determinant();
    Transform t;
    for (std::size_t i = 0; i < 3; i++) {
        for (std::size_t j = 0; j < 3; j++) t.m[i][j] = rows[i][j] * scale;
        t.m[i][3] = -(t.m[i][0] * m[0][3] + t.m[i][1] * m[1][3] + t.m[i][2] * m[2][3]);
    }
    return t;
}

Bounds Transform::box(const Bounds& b) const
{
    Bounds result;
    for (unsigned corner = 0; corner < 8 && !b.empty(); corner++)
        result.extend(point({corner & 1 ? b.upper.x : b.lower.x, corner & 2 ? b.upper.y : b.lower.y, corner & 4 ? b.upper.z : b.lower.z}));
    return result;
}

double Transform::determinant() const
{
    return dot(column(*this, 0), cross(column(*this, 1), column(*this, 2)));
}

bool Transform::is_affine() const
{
    return m[3][0] == 0.0 && m[3][1] == 0.0 && m[3][2] == 0.0 && m[3][3] == 1.0;
}

bool Transform::is_identity() const
{
    return m == Transform().m;
}

bool Transform::is_finite() const
{
    for (const auto& row : m)
        for (double value : row)
            if (!std::isfinite(value)) return false;
    return true;
}

bool Transform::is_singular() const
{
    double volume = 1.0;
    for (std::size_t j = 0; j < 3; j++) volume *= std::sqrt(dot(column(*this, j), column(*this, j)));
    return !(std::abs(determinant()) > 1e-12 * volume);
}

std::optional<double> Transform::uniform_scale(double tolerance) const
{
    const double scale = std::cbrt(std::abs(determinant()));
    for (std::size_t i = 0; i < 3; i++)
        for (std::size_t j = i; j < 3; j++) {
            const double expected = i == j ? scale * scale : 0.0;
            if (!(std::abs(dot(column(*this, i), column(*this, j)) - expected) <= tolerance * scale * scale)) return {};
        }
    return scale;
}

Transform operator*(const Transform& a, const Transform& b)
{
    Transform t;
    for (std::size_t i = 0; i < 4; i++)
        for (std::size_t j = 0; j < 4; j++) {
            t.m[i][j] = 0.0;
            for (std::size_t k = 0; k < 4; k++) t.m[i][j] += a.m[i][k] * b.m[k][j];
        }
    return t;
}

} // namespace sundog
