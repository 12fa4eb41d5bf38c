// Scenes with instances for tests, and the same with copies of the geometry.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace sundog
{

// Puts all shapes from `first` on into a new group, and instances of it into the world.
inline void make_instances(Scene& scene, std::size_t first, const std::vector<Transform>& placements)
{
    const uint group = static_cast<uint>(scene.groups.size());
    scene.groups.emplace_back();
    for (std::size_t i = first; i < scene.shapes.size(); i++) scene.shapes[i].group = group;
    for (const Transform& to_world : placements) scene.instances.push_back({"", {}, group, to_world});
}

inline TriangleMesh transformed(TriangleMesh mesh, const Transform& to_world)
{
    for (Vec3& p : mesh.positions) p = to_world.point(p);
    for (Vec3& n : mesh.normals) n = to_world.normal(n);
    if (to_world.determinant() < 0.0) // what was outside stays outside
        for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    return mesh;
}

// Turned, mirrored, stretched, sheared, tiny and far: what transforms can do, with sizes of about 1.
inline std::vector<Transform> assorted_placements()
{
    const auto turn = Transform::rotate({1, 2, 3}, 50);
    Transform shear;
    shear.m[0][1] = 0.8;
    shear.m[2][0] = -0.5;
    return {Transform(),
            Transform::translate({2, -1, 0.5}) * turn,
            Transform::translate({-2, 1, 1}) * turn * Transform::scale({-1, 1, 1}),
            Transform::translate({0, 2.5, -1}) * turn * Transform::scale({0.2, 1.5, -0.7}) * Transform::rotate({3, -1, 1}, 70),
            Transform::translate({0.5, -2.5, 1.5}) * shear * Transform::scale({0.6, 0.6, 0.6}),
            Transform::translate({-2.5, -1.5, -2}) * Transform::scale({1e-2, 2e-2, 1e-2}),
            Transform::translate({2.5, 2, -2}) * Transform::scale({1e-3, 1e-3, 1e-3}) * turn};
}

} // namespace sundog
