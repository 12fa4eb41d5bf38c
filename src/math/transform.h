// Linear maps of space as 4x4 matrices. In double precision, so that a chain of rotations, scales
// and their inverse transposes loses nothing that a float would show.
#pragma once

#include "math/bounds.h"
#include "math/double3.h"

#include <optional>

namespace sundog
{

// Maps column vectors: transform * point. a * b applies b first.
struct Transform {
    std::array<std::array<double, 4>, 4> m = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}; // m[row][column]

    static Transform translate(Double3 offset);
    static Transform scale(Double3 factors);
    // Counter-clockwise about `axis` (any length but zero) as seen from its tip.
    static Transform rotate(Double3 axis, double degrees);
    // Camera to world in Mitsuba's frame: +z runs from origin to target, +y lies on the side of `up`, and
    // +x = up x z points to the left of the image. Without `up`, any direction across. Nothing when origin
    // and target coincide or `up` is parallel to the view.
    static std::optional<Transform> look_at(Double3 origin, Double3 target, std::optional<Double3> up);

    Vec3 point(Vec3 p) const;
    Double3 exact_point(const Double3& p) const;
    Vec3 vector(Vec3 v) const;
    // Unit normal of the mapped surface whose normal was n: by the inverse transpose, so that what was
    // outside stays outside under reflections too.
    Vec3 normal(Vec3 n) const;

    // The same map to places that are counted from `origin`; the bits of this one where that is 0.
    Transform relative_to(const Double3& origin) const;
    // Of an affine map that is not singular.
    Transform inverse() const;
    // Box of the mapped box, empty for an empty one.
    Bounds box(const Bounds& b) const;

    double determinant() const; // of the linear part; negative for reflections
    bool is_affine() const;     // last row is 0 0 0 1
    bool is_finite() const;
    bool is_identity() const;
    // Whether the linear part flattens space: its determinant vanishes against the lengths of its columns.
    bool is_singular() const;
    // The factor by which all lengths change, where that is one factor within the relative tolerance:
    // a rotation, reflection and uniform scale. Nothing for shears and non-uniform scales.
    std::optional<double> uniform_scale(double tolerance = 1e-3) const;
};

Transform operator*(const Transform& a, const Transform& b);

} // namespace sundog
