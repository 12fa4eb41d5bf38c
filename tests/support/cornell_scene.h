// A Cornell box in code, side 2 about the origin, for tests that need light to bounce.
#pragma once

#include "scene/scene.h"

namespace sundog::test {

inline ShapeDescription make_quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d, uint bsdf)
{
    ShapeDescription shape;
    TriangleMesh mesh;
    mesh.positions = {a, b, c, d};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    shape.geometry = mesh;
    shape.bsdf = bsdf;
    return shape;
}

inline uint add_bsdf(Scene& scene, decltype(BsdfDescription::model) model)
{
    scene.bsdfs.push_back({"", {}, std::move(model)});
    return static_cast<uint>(scene.bsdfs.size() - 1);
}

inline ShapeDescription make_sphere(Vec3 center, float radius, uint bsdf)
{
    ShapeDescription shape;
    shape.geometry = Sphere{center, radius, false};
    shape.bsdf = bsdf;
    return shape;
}

// Five walls, open towards the camera at +z, an area light under the ceiling, nothing in it.
inline Scene cornell_box(int size)
{
    Scene scene;
    scene.file = "cornell box";
    const uint white = add_bsdf(scene, DiffuseBsdf{{0.75f, 0.75f, 0.75f}});
    const uint red = add_bsdf(scene, DiffuseBsdf{{0.65f, 0.06f, 0.06f}});
    const uint green = add_bsdf(scene, DiffuseBsdf{{0.14f, 0.45f, 0.09f}});
    scene.shapes.push_back(make_quad({-1, -1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, white));
    scene.shapes.push_back(make_quad({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}, white));
    scene.shapes.push_back(make_quad({-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, white));
    scene.shapes.push_back(make_quad({-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}, red));
    scene.shapes.push_back(make_quad({1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}, green));
    ShapeDescription light = make_quad({-.25f, .99f, -.25f}, {.25f, .99f, -.25f}, {.25f, .99f, .25f}, {-.25f, .99f, .25f}, white);
    light.emitter = AreaEmitter{{15, 15, 15}};
    scene.shapes.push_back(light);
    scene.sensor.position = {0, 0, 3.9f};
    scene.sensor.axis_x = {-1, 0, 0};
    scene.sensor.axis_y = {0, 1, 0};
    scene.sensor.axis_z = {0, 0, -1};
    scene.sensor.fov_x = 0.68f;
    scene.film.width = scene.film.height = scene.film.crop_width = scene.film.crop_height = size;
    scene.film.filter = {FilterKind::box, 0.5f, 0.5f, 0, 0};
    return scene;
}

// The same with a glass ball, whose caustic is on the floor.
inline Scene glass_box(int size)
{
    Scene scene = cornell_box(size);
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    scene.shapes.push_back(make_sphere({.4f, -.6f, .3f}, .4f, glass));
    return scene;
}

} // namespace sundog::test
