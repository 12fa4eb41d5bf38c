// Path space regularization: its bias goes as the square of the angle, and where nothing is specular it changes nothing.

#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <numbers>

using namespace sundog;
using namespace sundog::test;

namespace
{

constexpr int replicates = 12;

std::map<std::string, std::string> fixed_angle(const std::string& degrees, const std::string& paths = "path")
{
    std::map<std::string, std::string> result{{"sampler", "independent"}, {"max_depth", "6"}, {"angle", degrees}, {"rate", "0"}, {"paths", paths}};
    if (paths == "bdpt") result["photons"] = "1024";
    return result;
}

// What remains without the part of the bias that goes as the square of the angle: (4 E(gamma) - E(2 gamma)) / 3.
Estimate extrapolated(const Estimate& narrow, const Estimate& wide)
{
    return {(4 * narrow.mean - wide.mean) / 3, std::hypot(4 * narrow.standard_error, wide.standard_error) / 3};
}

// A point light at height 1 over a diffuse floor, 1 in front of a mirror: its image is a second one. All pixels see the floor at the
// same place, 0.5 in front of the mirror.
struct MirroredPoint {
    static constexpr double reflectance = 0.5;
    static constexpr double light_x = 1.0, seen_x = 0.5;

    static Scene scene()
    {
        Scene scene;
        scene.file = "mirrored point";
        scene.bsdfs.push_back({"", {}, DiffuseBsdf{{float(reflectance), float(reflectance), float(reflectance)}}});
        scene.bsdfs.push_back({"", {}, ConductorBsdf{}});
        add_quad(scene, {{0, -50, 0}, {50, -50, 0}, {50, 50, 0}, {0, 50, 0}}, 0);
        add_quad(scene, {{0, -50, 0}, {0, 50, 0}, {0, 50, 50}, {0, -50, 50}}, 1);
        scene.emitters.push_back({{}, PointEmitter{{float(light_x), 0, 1}, {1, 1, 1}}});
        scene.sensor.position = {float(seen_x), 0, 5};
        scene.sensor.axis_x = {-1, 0, 0};
        scene.sensor.axis_y = {0, 1, 0};
        scene.sensor.axis_z = {0, 0, -1};
        scene.sensor.fov_x = 1e-4f;
        scene.film.width = scene.film.height = scene.film.crop_width = scene.film.crop_height = 64;
        scene.film.filter = {FilterKind::box, 0.5f, 0.5f, 0, 0};
        return scene;
    }

    static void add_quad(Scene& scene, std::vector<Vec3> corners, uint bsdf)
    {
        TriangleMesh mesh;
        mesh.positions = std::move(corners);
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
        ShapeDescription shape;
        shape.geometry = mesh;
        shape.bsdf = bsdf;
        scene.shapes.push_back(shape);
    }

    // Radiance of the floor by a source at horizontal distance x.
    static double from(double x) { return reflectance / std::numbers::pi / std::pow(1 + x * x, 1.5); }
    static double answer() { return from(light_x - seen_x) + from(light_x + seen_x); }
};

TEST(Regularization, BiasGoesAsTheSquareOfTheAngle)
{
    const Scene scene = MirroredPoint::scene();
    const double truth = MirroredPoint::answer();
    const Estimate narrow = estimate_image_mean(scene, {"psr", 40, fixed_angle("12")}, replicates);
    const Estimate wide = estimate_image_mean(scene, {"psr", 10, fixed_angle("24")}, replicates);
    const double quantile = student_quantile(replicates - 1, 0.005 / 2);
    const Estimate limit = extrapolated(narrow, wide);
    // Of the fourth order there is 4 gamma^4 times some number around 1 at gamma = 0.2: less than 1%.
    EXPECT_NEAR(limit.mean, truth, quantile * limit.standard_error + 0.01 * truth);
    EXPECT_LT(limit.standard_error, 0.01 * allowed_noise() * truth);
    EXPECT_GT(std::abs(wide.mean - truth), quantile * wide.standard_error) << "no bias to see";
    EXPECT_GT(std::abs(wide.mean - truth), 2.0 * std::abs(narrow.mean - truth));
}

// A point light within a glass ball, and a mirror, in a box: all light is a caustic, and the mirror shows it again.
Scene glass_lamp_box()
{
    Scene scene = cornell_box(32);
    std::erase_if(scene.shapes, [](const ShapeDescription& shape) { return shape.emitter.has_value(); });
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    const uint mirror = add_bsdf(scene, ConductorBsdf{});
    scene.shapes.push_back(make_sphere({0, .2f, 0}, .35f, glass));
    scene.shapes.push_back(make_sphere({-.45f, -.6f, -.3f}, .4f, mirror));
    scene.emitters.push_back({{}, PointEmitter{{.05f, .25f, 0}, {1, 1, 1}}});
    return scene;
}

void expect_light_of_photons(const std::string& paths, std::uint64_t iterations)
{
    const Scene scene = glass_lamp_box();
    EXPECT_EQ(image_mean(render(scene, {paths, 1, {}}, 1)) == 0.0, paths == "path");
    const Estimate photons =
        estimate_image_mean(scene, {"pppm", 12, {{"sampler", "independent"}, {"max_depth", "6"}, {"photons", "16384"}, {"radius", "0.01"}}}, replicates);
    const Estimate limit = extrapolated(estimate_image_mean(scene, {"psr", iterations, fixed_angle("8", paths)}, replicates),
                                        estimate_image_mean(scene, {"psr", iterations / 4, fixed_angle("16", paths)}, replicates));
    const double error = std::hypot(limit.standard_error, photons.standard_error);
    // The photons' edges, as in agreement tests; and the fourth order, some gamma^4 of 0.14.
    EXPECT_NEAR(limit.mean, photons.mean, student_quantile(replicates - 1, 0.005) * error + (0.005 + 0.003) * photons.mean);
    EXPECT_LT(error, 0.03 * allowed_noise() * photons.mean);
}

TEST(Regularization, OfBdptFindsAllLightOfALampInGlass)
{
    expect_light_of_photons("bdpt", 48);
}

// Chains start anew whenever the angle narrows, after 1, 2, 4, 8 iterations: with an angle that stays the mean does.
TEST(Regularization, OfMarkovChainsIsThatOfTheirPaths)
{
    const Scene scene = MirroredPoint::scene();
    const double quantile = student_quantile(replicates - 1, 0.005);
    const Estimate paths = estimate_image_mean(scene, {"psr", 4, fixed_angle("24")}, replicates);
    const Estimate chains = estimate_image_mean(
        scene, {"psr", 7, {{"paths", "pssmlt"}, {"chains", "1024"}, {"seeds", "8192"}, {"max_depth", "6"}, {"angle", "24"}, {"rate", "0"}}}, replicates);
    const double error = std::hypot(paths.standard_error, chains.standard_error);
    EXPECT_NEAR(chains.mean, paths.mean, quantile * error);
    EXPECT_LT(error, 0.02 * allowed_noise() * paths.mean);
}

TEST(LongRegularization, OfPathFindsAllLightOfALampInGlass)
{
    expect_light_of_photons("path", 160);
}

TEST(Regularization, ChangesNothingWhereNothingIsSpecular)
{
    const Scene scene = cornell_box(32);
    EXPECT_EQ(render(scene, {"psr", 2, {}}, 5).pixels, render(scene, {"path", 2, {}}, 5).pixels);
    EXPECT_EQ(render(scene, {"psr", 2, {{"paths", "bdpt"}}}, 5).pixels, render(scene, {"bdpt", 2, {}}, 5).pixels);
}

// Light that path finds by itself, a lamp of some area behind glass, is not counted twice.
TEST(Regularization, LeavesLampsWithAnAreaAlone)
{
    Scene scene = cornell_box(32);
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    scene.shapes.push_back(make_sphere({0, -.2f, 0}, .5f, glass));
    EXPECT_EQ(render(scene, {"psr", 2, {{"angle", "90"}}}, 5).pixels, render(scene, {"path", 2, {}}, 5).pixels);
}

} // namespace
