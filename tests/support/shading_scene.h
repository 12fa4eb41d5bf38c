// A scene in which every kind of material, light and shape meets a path within a few bounces, for tests of shading stages.
#pragma once

#include "math/transform.h"
#include "support/scene_builder.h"

namespace sundog
{

struct ShadingSceneOptions {
    bool constant_light = true;
    bool thin_lens = false;
    FilterKind filter = FilterKind::mitchell; // has negative lobes
};

// All is turned, so that no normal lies in a coordinate plane, where frames change their sign.
class ShadingScene : public SceneBuilder
{
public:
    explicit ShadingScene(const ShadingSceneOptions& options)
    {
        scene.bsdfs[0].model = DiffuseBsdf{{0, 0, 0}}; // what the lights are made of
        const uint red = bsdf(DiffuseBsdf{{0.7f, 0.2f, 0.15f}});
        const uint green = bsdf(DiffuseBsdf{{0.2f, 0.6f, 0.3f}});
        const uint gold = bsdf(ConductorBsdf{{0.143f, 0.375f, 1.442f}, {3.98f, 2.39f, 1.6f}, {1.0f, 0.9f, 0.8f}});
        const uint red_and_green = bsdf(TwoSidedBsdf{red, green});
        const uint gold_and_red = bsdf(TwoSidedBsdf{gold, red});
        const uint glass = bsdf(DielectricBsdf{1.5f, 1.0f, false, {0.9f, 1.0f, 0.95f}, {0.95f, 0.9f, 1.0f}});
        const uint pane = bsdf(DielectricBsdf{1.7f, 1.1f, true, {1.0f, 0.9f, 0.8f}, {0.8f, 0.9f, 1.0f}});
        const uint nothing = bsdf(NullBsdf{});

        // A box without front and ceiling.
        TriangleMesh floor = quad({-1, -1, 1}, {2, 0, 0}, {0, 0, -2});
        floor.normals = {turned({-0.5f, 1, 0.4f}), turned({0.5f, 1, 0.4f}), turned({0.6f, 1, -0.6f}), turned({-0.4f, 1, -0.5f})};
        for (Vec3& normal : floor.normals) normal = normalize(normal);
        shape(floor, green);
        shape(quad({-1, -1, -1}, {2, 0, 0.8f}, {0, 2, 0}), red_and_green);
        shape(quad({-1, -1, -1}, {0, 0, 2}, {0, 2, 0}), red); // its back faces the box
        shape(quad({1, -1, -1}, {0, 0, 2}, {0, 2, 0}), gold_and_red);
        // What stands in it.
        shape(octahedron({-0.4f, -0.55f, 0.1f}, 0.42f), glass);
        shape(Sphere{turned({0.45f, -0.6f, 0.3f}), 0.35f, false}, glass);
        shape(Sphere{turned({0.1f, 0.35f, -0.4f}), 0.3f, false}, gold);
        shape(quad({-0.95f, -0.1f, 0.5f}, {0.5f, 0, 0.2f}, {0, 0.6f, 0}), pane);
        shape(quad({0.3f, 0.0f, 0.6f}, {0.6f, 0, -0.2f}, {0, 0.5f, 0}), nothing);
        shape(quad({-0.3f, 0.45f, 0.5f}, {-0.4f, 0.1f, 0.2f}, {0, 0.4f, 0.1f}), gold); // seen from behind
        shape(Disk{turned({-0.1f, -0.5f, 0.8f}), turned({0.2f, 0, 0.05f}), turned({0, 0.15f, 0.1f})}, gold_and_red);
        // Lights, each with about the same power.
        light(quad({-0.3f, 0.95f, -0.3f}, {0.6f, 0, 0.05f}, {0, 0.05f, 0.7f}), {6, 7, 5});
        light(Sphere{turned({-0.65f, 0.7f, -0.55f}), 0.25f, false}, {2.5f, 3, 2});
        light(Disk{turned({0.6f, 0.8f, 0.2f}), turned({0.3f, 0, 0.05f}), turned({0, 0.15f, 0.4f})}, {5, 6, 4});
        // One that glows inwards, lets paths in, and holds something that it lights.
        light(Sphere{turned({0.62f, 0.35f, -0.05f}), 0.25f, true}, {2.5f, 2, 3});
        scene.shapes.back().bsdf = nothing;
        shape(quad({0.55f, 0.25f, -0.1f}, {0.14f, 0.03f, 0.02f}, {0.02f, 0.16f, 0.06f}), red_and_green);
        emitter(PointEmitter{turned({0.5f, 0.9f, 0.6f}), {0.7f, 0.5f, 0.6f}});
        emitter(SpotEmitter{turned({-0.2f, 0.9f, 0.9f}), normalize(turned({0.1f, -1, -0.6f})), {7, 8, 6}, 0.7f, 0.3f});
        emitter(DirectionalEmitter{normalize(turned({0.3f, -1, -0.5f})), {0.4f, 0.35f, 0.3f}});
        if (options.constant_light) emitter(ConstantEmitter{{0.03f, 0.04f, 0.05f}});
        place_camera(options);
    }

private:
    void place_camera(const ShadingSceneOptions& options)
    {
        scene.sensor.position = turned({0.1f, 0.2f, 4});
        scene.sensor.axis_x = turned({-1, 0, 0});
        scene.sensor.axis_y = turned({0, 1, 0});
        scene.sensor.axis_z = turned({0, 0, -1});
        scene.sensor.fov_x = 0.75f;
        scene.sensor.near_clip = 0.5f;
        scene.sensor.far_clip = 4.7f; // cuts off a part of the box
        if (options.thin_lens) {
            scene.sensor.aperture_radius = 0.1f;
            scene.sensor.focus_distance = 3.5f;
        }
        scene.film.width = 130;
        scene.film.height = 120;
        scene.film.crop_x = 5;
        scene.film.crop_y = 26;      // the smooth floor is in sight
        scene.film.crop_width = 107; // no multiples of a tile
        scene.film.crop_height = 83;
        scene.film.filter.kind = options.filter;
    }

    static Vec3 turned(Vec3 v)
    {
        static const Transform turn = Transform::rotate({1, 2, 3}, 40);
        return turn.vector(v);
    }

    static TriangleMesh quad(Vec3 corner, Vec3 u, Vec3 v) { return parallelogram(turned(corner), turned(u), turned(v)); }

    // With normals as of a ball.
    static TriangleMesh octahedron(Vec3 center, float radius)
    {
        TriangleMesh mesh;
        for (const Vec3 tip : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
            mesh.positions.push_back(turned(center + tip * radius));
            mesh.normals.push_back(turned(tip));
        }
        mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
        return mesh;
    }
};

} // namespace sundog
