// Scenes for tests, put together in a few lines.
#pragma once

#include "scene/scene.h"

#include <utility>

namespace sundog
{

// A parallelogram of two triangles whose normal is along u x v.
inline TriangleMesh parallelogram(Vec3 corner, Vec3 u, Vec3 v)
{
    return {.positions = {corner, corner + u, corner + u + v, corner + v}, .normals = {}, .uvs = {}, .triangles = {{0, 1, 2}, {0, 2, 3}}, .attributes = {}};
}

inline TriangleMesh triangle(Vec3 a, Vec3 b, Vec3 c)
{
    return {.positions = {a, b, c}, .normals = {}, .uvs = {}, .triangles = {{0, 1, 2}}, .attributes = {}};
}

// Starts with one diffuse BSDF of reflectance 1/2, number 0.
class SceneBuilder
{
public:
    SceneBuilder() { bsdf(DiffuseBsdf{}); }

    template <class Model> uint bsdf(Model model)
    {
        scene.bsdfs.push_back({{}, {}, std::move(model)});
        return static_cast<uint>(scene.bsdfs.size() - 1);
    }

    template <class Geometry> SceneBuilder& shape(Geometry geometry, uint bsdf = 0)
    {
        scene.shapes.push_back({{}, {}, std::move(geometry), bsdf, {}});
        return *this;
    }

    // An area light on a surface of BSDF 0.
    template <class Geometry> SceneBuilder& light(Geometry geometry, Vec3 radiance)
    {
        scene.shapes.push_back({{}, {}, std::move(geometry), 0, AreaEmitter{radiance}});
        return *this;
    }

    template <class Emitter> SceneBuilder& emitter(Emitter model)
    {
        scene.emitters.push_back({{}, std::move(model)});
        return *this;
    }

    Scene scene;
};

} // namespace sundog
