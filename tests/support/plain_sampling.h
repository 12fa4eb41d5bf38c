// From uniform numbers to points and directions, in double precision.
#pragma once

#include "support/double3.h"
#include "support/plain_doubt.h"
#include "support/plain_random.h"

#include <algorithm>
#include <numbers>

namespace sundog
{

using std::numbers::pi;

// Directions closer to a plane than this have lost digits in the cosine, sqrt(1 - r^2).
constexpr double grazing = 0.03;

// Frame about n by the rotation that takes the pole +z to n; for n on the lower half, by the reflection that takes -z
// to n, with t turned to keep the frame right-handed. [Frisvad 2012; Duff et al. 2017]
struct PlainFrame {
    Vec3d s, t, n;

    PlainFrame(Vec3d normal, Doubt& doubt) : n(normal)
    {
        const bool upper = !doubt.less(n.z, 0.0, 1e-6);
        const Vec3d pole(0, 0, upper ? 1 : -1), between = n + pole;
        s = Vec3d(1, 0, 0) - between * (n.x / (1.0 + std::abs(n.z)));
        t = Vec3d(0, 1, 0) - between * (n.y / (1.0 + std::abs(n.z)));
        if (!upper) t = -t;
    }
    Vec3d to_world(Vec3d v) const { return s * v.x + t * v.y + n * v.z; }
};

// [Shirley and Chiu 1997]: squares about the origin become circles; the square's right quarter the disk's.
inline Pair plain_disk(Pair u)
{
    const double x = 2.0 * u[0] - 1.0, y = 2.0 * u[1] - 1.0;
    if (x == 0.0 && y == 0.0) return {0.0, 0.0};
    double radius, angle;
    if (std::abs(x) > std::abs(y)) {
        radius = x;
        angle = pi / 4.0 * y / x;
    } else {
        radius = y;
        angle = pi / 2.0 - pi / 4.0 * x / y;
    }
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

// About +z with density cos / pi: Malley's method.
inline Vec3d plain_cosine_hemisphere(Pair u, Doubt& doubt)
{
    const Pair p = plain_disk(u);
    const double z = std::sqrt(std::max(0.0, 1.0 - p[0] * p[0] - p[1] * p[1]));
    doubt.rests_on(z, grazing);
    return {p[0], p[1], z};
}

// Uniform within a cone about +z: uniform in the height 1 - cos and in the azimuth, which starts at -pi.
inline Vec3d plain_cone(Pair u, double one_minus_cos)
{
    const double cosine = 1.0 - u[0] * one_minus_cos, azimuth = pi * (2.0 * u[1] - 1.0);
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

inline Vec3d plain_sphere(Pair u)
{
    return plain_cone(u, 2.0);
}

// Barycentric weights of the second and third vertex: the unit square's two halves beside its diagonal are sheared onto
// the triangle's two [Heitz 2019, A Low-Distortion Map Between Triangle and Square].
inline Pair plain_triangle(Pair u)
{
    if (u[1] > u[0]) return {u[0] / 2.0, u[1] - u[0] / 2.0};
    return {u[0] - u[1] / 2.0, u[1] / 2.0};
}

// The direction that two octahedral coordinates of 16 bits stand for [Cigolle et al. 2014].
inline Vec3d unpacked_direction(uint packed)
{
    const double x = ((packed & 0xffff) + 0.5) / 32768.0 - 1.0, y = ((packed >> 16) + 0.5) / 32768.0 - 1.0;
    const double z = 1.0 - std::abs(x) - std::abs(y), fold = std::max(0.0, -z);
    return normalized(Vec3d(x - std::copysign(fold, x), y - std::copysign(fold, y), z));
}

inline double angle_between(Vec3d a, Vec3d b)
{
    return std::atan2(length(cross(a, b)), dot(a, b));
}

} // namespace sundog
