// A scene in millimetres and the same in kilometres render alike, also far from the origin: radii and ray
// offsets follow the scene's size and coordinates.

#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

using namespace sundog;
using namespace sundog::test;

namespace {

// Every length times `scale`, then moved. Radiance does not depend on scale.
Scene scaled(Scene scene, float scale, Vec3 offset)
{
    for (ShapeDescription& shape : scene.shapes) {
        if (auto* mesh = std::get_if<TriangleMesh>(&shape.geometry))
            for (Vec3& p : mesh->positions) p = p * scale + offset;
        if (auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
            sphere->center = sphere->center * scale + offset;
            sphere->radius *= scale;
        }
    }
    scene.sensor.position = scene.sensor.position * scale + offset;
    scene.sensor.near_clip *= scale;
    scene.sensor.far_clip *= scale;
    return scene;
}

struct Size {
    float scale;
    Vec3 offset;
};

const Size sizes[] = {{1e-3f, {0, 0, 0}}, {1.0f, {0, 0, 0}}, {1e4f, {0, 0, 0}}, {1.0f, {300, -200, 500}}};

TEST(ScaleFree, FurnaceKeepsItsRadiance)
{
    for (const Size& size : sizes) {
        const Scene scene = scaled(load_test_scene("analytic/furnace.xml"), size.scale, size.offset);
        for (const char* method : {"path", "sppm", "vcm"}) {
            RenderRequest request{method, 16, {{"sampler", "independent"}}};
            if (request.method == "sppm") request.parameters["photons"] = "8192"; // automatic radius: 0.06 sides of the box
            const Estimate estimate = estimate_image_mean(scene, request, 8);
            // Light that leaks, or surfaces that shade themselves, would show as a loss.
            EXPECT_NEAR(estimate.mean, 2.0, student_quantile(7, 0.005 / 8) * estimate.standard_error + 1e-4) << method << ", scale " << size.scale;
        }
    }
}

TEST(ScaleFree, GlassBoxKeepsItsImage)
{
    Scene box = cornell_box(32);
    const uint glass = add_bsdf(box, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    box.shapes.push_back(make_sphere({.4f, -.55f, .3f}, .4f, glass));
    for (const char* method : {"path", "sppm"}) {
        std::vector<Estimate> estimates;
        for (const Size& size : sizes)
            estimates.push_back(estimate_image_mean(scaled(box, size.scale, size.offset), {method, 32, {{"sampler", "independent"}, {"max_depth", "8"}}}, 8));
        for (const Estimate& e : estimates) {
            const double error = std::hypot(e.standard_error, estimates[1].standard_error);
            EXPECT_NEAR(e.mean, estimates[1].mean, student_quantile(7, 0.005 / 8) * error) << method;
            EXPECT_LT(error, 0.02 * allowed_noise() * e.mean) << method;
        }
    }
}

} // namespace
