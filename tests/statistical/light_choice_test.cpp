// How lights are chosen changes noise, not the mean: by tree and by power, for surfaces of every kind under lights of
// every kind; a weak lamp among strong ones; lights that throw images, in all methods.
#include "support/cornell_scene.h"
#include "support/light_image.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

using namespace sundog;
using namespace sundog::test;

namespace
{

constexpr int size = 24;
constexpr int blocks = 2;
constexpr int replicates = 10;

struct Contestant {
    std::string name;
    const Scene* scene;
    RenderRequest request;
};

std::vector<Estimate> window_estimates(const Scene& scene, const RenderRequest& request)
{
    std::vector<std::vector<double>> values(blocks * blocks + 1);
    constexpr int step = size / blocks;
    for (int seed = 1; seed <= replicates; seed++) {
        const Image image = render_sampled(scene, request, seed);
        for (int w = 0; w < blocks * blocks; w++) {
            const int x = w % blocks * step, y = w / blocks * step;
            values[static_cast<std::size_t>(w)].push_back(window_mean(image, x, y, x + step, y + step));
        }
        values.back().push_back(image_mean(image));
    }
    std::vector<Estimate> estimates;
    for (const auto& v : values) estimates.push_back(estimate_from(v));
    return estimates;
}

// Student's test of each window, with Bonferroni's correction at a family-wise 1%. bias: relative, of density estimation.
void expect_agreement(const std::vector<Contestant>& contestants, double bias, double power = 0.05)
{
    std::vector<std::vector<Estimate>> all;
    for (const auto& c : contestants) all.push_back(window_estimates(*c.scene, c.request));
    const double comparisons = static_cast<double>(all.size() * (all.size() - 1) / 2 * all[0].size());
    const double quantile = student_quantile(replicates - 1, 0.005 / comparisons);
    for (std::size_t a = 0; a < all.size(); a++)
        for (std::size_t b = a + 1; b < all.size(); b++)
            for (std::size_t w = 0; w < all[a].size(); w++) {
                const Estimate &x = all[a][w], &y = all[b][w];
                const double error = std::hypot(x.standard_error, y.standard_error);
                EXPECT_NEAR(x.mean, y.mean, quantile * error + bias * x.mean)
                    << contestants[a].name << " and " << contestants[b].name << ", window " << w;
                EXPECT_LT(error, power * allowed_noise() * x.mean)
                    << contestants[a].name << " and " << contestants[b].name << ", window " << w; // the test has power
            }
}

RenderRequest request(const std::string& method, std::uint64_t iterations, const std::map<std::string, std::string>& more = {})
{
    RenderRequest r{method, iterations, {{"sampler", "independent"}, {"max_depth", "5"}}};
    if (method != "path") r.parameters["photons"] = "8192";
    if (method == "pppm" || method == "sppm") r.parameters["radius"] = "0.02";
    for (const auto& [name, value] : more) r.parameters[name] = value;
    return r;
}

// Large and small lights among ground glass, narrow and broad metal, plastic and relief: where BSDF sampling finds the
// lights as often as next-event estimation, a wrong density for the choice of a light would show.
Scene furnished_box()
{
    Scene scene = cornell_box(size);
    const Vec3 eta{0.2f, 0.9f, 1.1f}, k{3.9f, 2.5f, 2.1f};
    const uint broad = add_bsdf(scene, ConductorBsdf{eta, k, {}, Roughness{false, 0.4f, 0.4f}});
    const uint narrow = add_bsdf(scene, ConductorBsdf{eta, k, {}, Roughness{false, 0.1f, 0.1f}});
    const uint ground = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {}, {}, Roughness{false, 0.4f, 0.4f}});
    const uint plastic = add_bsdf(scene, PlasticBsdf{1.5f, 1.0f, {.2f, .3f, .7f}, {1, 1, 1}, false, Roughness{false, 0.3f, 0.3f}});
    const uint black = add_bsdf(scene, DiffuseBsdf{{0, 0, 0}});
    scene.shapes.push_back(make_sphere({.55f, -.65f, .3f}, .33f, broad));
    scene.shapes.push_back(make_sphere({-.55f, -.65f, .3f}, .33f, narrow));
    scene.shapes.push_back(make_sphere({0, -.2f, .1f}, .33f, ground));
    scene.shapes.push_back(make_sphere({.5f, .3f, -.4f}, .33f, plastic));
    const auto light = [&](ShapeDescription shape, float radiance) {
        shape.bsdf = black;
        shape.emitter = AreaEmitter{{radiance, radiance, radiance}};
        scene.shapes.push_back(shape);
    };
    light(make_sphere({-.7f, .2f, .2f}, .2f, black), 3);
    light(make_sphere({0, -.9f, -.6f}, .08f, black), 9);
    light(make_quad({-.9f, -.4f, -.9f}, {-.9f, .4f, -.9f}, {-.5f, .4f, -.95f}, {-.5f, -.4f, -.95f}, black), 3);
    light(make_quad({.2f, -.98f, .5f}, {.2f, -.98f, .9f}, {.6f, -.98f, .9f}, {.6f, -.98f, .5f}, black), 3);
    ShapeDescription disk;
    disk.geometry = Disk{{.7f, .8f, .2f}, {.15f, 0, 0}, {0, 0, .15f}};
    light(disk, 4);
    ShapeDescription tube;
    tube.geometry =
        Cylinder{.start = {-.3f, .7f, .6f}, .radius = .05f, .length = .6f, .axis_x = {0, 1, 0}, .axis_y = {0, 0, 1}, .axis_z = {1, 0, 0}};
    light(tube, 5);
    scene.emitters.push_back({{}, PointEmitter{{.2f, .3f, .7f}, {.1f, .1f, .1f}}});
    scene.emitters.push_back({{}, SpotEmitter{{.3f, .5f, .3f}, {0, -1, 0}, {.5f, .5f, .5f}, .5f, .3f}});
    scene.emitters.push_back({{}, DirectionalEmitter{normalize(Vec3{.2f, -.3f, -1}), {.3f, .3f, .3f}}});
    scene.emitters.push_back({{}, ConstantEmitter{{.2f, .2f, .2f}}});
    return scene;
}

TEST(LightChoice, TreeAndPowerAgree)
{
    const Scene scene = furnished_box();
    expect_agreement({{"path by tree", &scene, request("path", 48, {{"light_choice", "tree"}})},
                      {"path by power", &scene, request("path", 48, {{"light_choice", "power"}})},
                      {"pppm by tree", &scene, request("pppm", 12, {{"light_choice", "tree"}})},
                      {"bdpt by tree", &scene, request("bdpt", 24, {{"light_choice", "tree"}, {"photons", "1024"}})},
                      {"vcm by tree", &scene, request("vcm", 24, {{"light_choice", "tree"}, {"photons", "1024"}, {"radius", "0.02"}})}},
                     0.01);
}

// The same seed gives the same image, and choosing differently another one.
TEST(LightChoice, IsReproducible)
{
    const Scene scene = furnished_box();
    const auto pixels = [&](const char* choice) { return render(scene, request("path", 2, {{"light_choice", choice}}), 3).pixels; };
    EXPECT_TRUE(pixels("tree") == pixels("tree"));
    EXPECT_FALSE(pixels("tree") == pixels("power"));
    EXPECT_TRUE(pixels("auto") == pixels("tree")) << "many lights: chosen by the tree";
    const Scene one = cornell_box(size);
    const auto of_one = [&](const char* choice) { return render(one, request("path", 2, {{"light_choice", choice}}), 3).pixels; };
    EXPECT_TRUE(of_one("auto") == of_one("power")) << "one lamp: nothing to choose";
}

// 200 lamps in the box, behind each other's backs too: at equal paths the tree is far less noisy.
TEST(LightChoice, TreeLessNoisyAmongManyLamps)
{
    Scene scene = cornell_box(size);
    scene.shapes.pop_back();
    for (int i = 0; i < 200; i++) {
        const float x = static_cast<float>(i % 10) * .2f - .9f, z = static_cast<float>(i / 10 % 10) * .2f - .9f;
        scene.emitters.push_back({{}, PointEmitter{{x, i < 100 ? -.95f : .95f, z}, {.004f, .004f, .004f}}});
    }
    const auto image = [&](const char* choice, std::uint64_t iterations, std::uint64_t seed) {
        return render(scene, request("path", iterations, {{"light_choice", choice}, {"max_depth", "2"}}), seed);
    };
    const Image truth = image("tree", 128, 9);
    const auto error = [&](const char* choice) {
        const Image noisy = image(choice, 4, 1);
        double squares = 0.0, sum = 0.0;
        for (int y = 0; y < size; y++)
            for (int x = 0; x < size; x++) {
                const double t = truth.at(x, y, 1), d = noisy.at(x, y, 1) - t;
                squares += d * d;
                sum += t * t;
            }
        return squares / sum;
    };
    EXPECT_LT(error("tree"), 0.3 * error("power"));
}

// A lamp over a glass ball, and outside of the box, shining away from it, one 10^4 times as strong: as one emitter, which
// the floor of every emitter keeps from taking all photons; and in 64 parts, which leave the lamp a 65th of the floor.
Scene weak_lamp(int strong_parts)
{
    Scene scene = cornell_box(size);
    scene.shapes.pop_back();
    scene.shapes.push_back(make_sphere({0, -.3f, 0}, .4f, add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {}, {}})));
    scene.emitters.push_back({{}, PointEmitter{{0, .8f, 0}, {.5f, .5f, .5f}}});
    const float width = 16.0f / static_cast<float>(std::max(strong_parts, 1));
    for (int i = 0; i < strong_parts; i++) {
        const float x = -8.0f + width * static_cast<float>(i);
        ShapeDescription strong = make_quad({x, 9, -8}, {x, 9, 8}, {x + width, 9, 8}, {x + width, 9, -8}, 0); // faces up
        strong.emitter = AreaEmitter{{60, 60, 60}};
        scene.shapes.push_back(strong);
    }
    return scene;
}

TEST(LightChoice, AWeakLampsCausticHasItsPhotons)
{
    const Scene alone = weak_lamp(0), one = weak_lamp(1), many = weak_lamp(64);
    const RenderRequest photons = request("ptracer", 24);
    expect_agreement({{"the lamp alone", &alone, photons},
                      {"beside a strong light", &one, photons},
                      {"beside its 64 parts", &many, request("ptracer", 64)},
                      {"pppm beside a strong light", &one, request("pppm", 16, {{"direct", "photons"}})}},
                     0.01, 0.15);
    // The caustic: the floor below the ball. 819 of 8192 paths are the lamp's with a floor of its own, 13 with a 65th.
    const auto deviation = [&](const Scene& scene) {
        std::vector<double> means;
        for (std::uint64_t seed = 1; seed <= 16; seed++)
            means.push_back(window_mean(render(scene, request("ptracer", 4), seed), size / 4, 3 * size / 4, 3 * size / 4, size));
        return estimate_from(means).standard_error;
    };
    // The expected ratio is sqrt(32) = 5.7 of the deviations; each is known to a factor 1.5.
    EXPECT_LT(2.0 * deviation(one), deviation(many));
}

Scene projector_box()
{
    Scene scene = cornell_box(size);
    scene.shapes.pop_back();
    ProjectorEmitter projector{.position = {.1f, .2f, .9f},
                               .axis_x = {-1, 0, 0},
                               .axis_y = {0, 1, 0},
                               .axis_z = {0, 0, -1},
                               .half_width = .6f,
                               .half_height = .45f,
                               .irradiance = {3, 3, 3},
                               .texture = {}};
    projector.texture = add_light_image(scene, light_image(5, 4));
    scene.emitters.push_back({{}, projector});
    return scene;
}

Scene textured_spot_and_panel_box()
{
    Scene scene = cornell_box(size);
    const uint image = add_light_image(scene, light_image(6, 6));
    auto& lamp = scene.shapes.back();
    std::get<TriangleMesh>(lamp.geometry).uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    lamp.emitter->texture = image;
    SpotEmitter spot{{0, 0, .9f}, {0, 0, -1}, {2, 2, 2}, .6f, .4f};
    spot.texture = image;
    scene.emitters.push_back({{}, spot});
    return scene;
}

TEST(LightChoice, MethodsAgreeOnAProjectorsImage)
{
    const Scene scene = projector_box();
    expect_agreement({{"path", &scene, request("path", 48)},
                      {"ptracer", &scene, request("ptracer", 16)},
                      {"pppm", &scene, request("pppm", 12)},
                      {"pppm with photons alone", &scene, request("pppm", 16, {{"direct", "photons"}})}},
                     0.01);
}

TEST(LightChoice, MethodsAgreeOnTexturedLamps)
{
    const Scene scene = textured_spot_and_panel_box();
    expect_agreement({{"path by tree", &scene, request("path", 48, {{"light_choice", "tree"}})},
                      {"path", &scene, request("path", 48)},
                      {"ptracer", &scene, request("ptracer", 24)},
                      {"pppm", &scene, request("pppm", 18)}},
                     0.01);
}

// Light of any colours on grey walls is the same in spectral transport.
TEST(SpectralLights, AreThoseOfRgbOnGreyWalls)
{
    const auto open_box = [] {
        Scene scene = cornell_box(size);
        scene.shapes.pop_back();
        scene.shapes.erase(scene.shapes.begin() + 1, scene.shapes.begin() + 3); // ceiling and back wall
        EnvironmentEmitter map{};
        map.image = light_image(12, 7);
        map.scale = .3f;
        scene.emitters.push_back({{}, map});
        return scene;
    };
    for (const char* method : {"path", "pppm"}) {
        const RenderRequest base = request(method, method == std::string("path") ? 24 : 8);
        for (Scene scene : {projector_box(), textured_spot_and_panel_box(), open_box()}) {
            for (auto& bsdf : scene.bsdfs) bsdf.model = DiffuseBsdf{{.6f, .6f, .6f}};
            std::vector<std::vector<Estimate>> means;
            for (const char* spectral : {"false", "true"}) {
                std::vector<std::vector<double>> channels(3);
                for (int seed = 1; seed <= replicates; seed++) {
                    RenderRequest r = base;
                    r.parameters["spectral"] = spectral;
                    const Image image = render_sampled(scene, r, seed);
                    for (std::size_t c = 0; c < 3; c++) {
                        double sum = 0.0;
                        for (int y = 0; y < size; y++)
                            for (int x = 0; x < size; x++) sum += static_cast<double>(image.at(x, y, static_cast<int>(c)));
                        channels[c].push_back(sum / (size * size));
                    }
                }
                means.emplace_back();
                for (const auto& channel : channels) means.back().push_back(estimate_from(channel));
            }
            const double quantile = student_quantile(replicates - 1, 0.005 / 18);
            for (std::size_t c = 0; c < 3; c++) {
                const double error = std::hypot(means[0][c].standard_error, means[1][c].standard_error);
                EXPECT_NEAR(means[0][c].mean, means[1][c].mean, quantile * error) << method << ", channel " << c;
                EXPECT_LT(error, 0.06 * allowed_noise() * means[0][c].mean) << method << ", channel " << c;
            }
        }
    }
}

} // namespace
