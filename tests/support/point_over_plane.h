// A point light of intensity I at height h over a diffuse plane: irradiance I h / (h^2 + rho^2)^(3/2), known in every pixel.
#pragma once

#include "scene/scene.h"

#include <cmath>
#include <numbers>

namespace sundog::test
{

struct PointOverPlane {
    int size;          // pixels
    double half_patch; // the camera sees [-half_patch, half_patch]^2 of the plane

    static constexpr float height = 1.0f;
    static constexpr float reflectance = 0.5f;

    Scene scene() const
    {
        Scene scene;
        scene.file = "point over plane";
        scene.bsdfs.push_back({"", {}, DiffuseBsdf{{reflectance, reflectance, reflectance}}});
        TriangleMesh plane;
        plane.positions = {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}};
        plane.triangles = {{0, 1, 2}, {0, 2, 3}};
        ShapeDescription shape;
        shape.geometry = plane;
        scene.shapes.push_back(shape);
        scene.emitters.push_back({{}, PointEmitter{{0, 0, height}, {1, 1, 1}}});
        scene.sensor.position = {0, 0, 5};
        scene.sensor.axis_x = {-1, 0, 0};
        scene.sensor.axis_y = {0, 1, 0};
        scene.sensor.axis_z = {0, 0, -1};
        scene.sensor.fov_x = 2.0f * static_cast<float>(std::atan(half_patch / 5.0));
        scene.film.width = scene.film.height = scene.film.crop_width = scene.film.crop_height = size;
        scene.film.filter = {FilterKind::box, 0.5f, 0.5f, 0, 0};
        return scene;
    }

    // Mean radiance over the pixel's square on the plane, by the midpoint rule.
    double answer(int px, int py) const
    {
        constexpr int steps = 8;
        const double pixel = 2.0 * half_patch / size;
        double sum = 0.0;
        for (int i = 0; i < steps; i++)
            for (int j = 0; j < steps; j++) {
                const double x = -half_patch + (px + (i + 0.5) / steps) * pixel;
                const double y = -half_patch + (py + (j + 0.5) / steps) * pixel;
                sum += height / std::pow(height * height + x * x + y * y, 1.5);
            }
        return sum / (steps * steps) * reflectance / std::numbers::pi;
    }
};

} // namespace sundog::test
