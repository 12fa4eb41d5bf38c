// Images of scenes with instances are those of the same scenes with copies.
#include "scene/fingerprint.h"
#include "support/cornell_scene.h"
#include "support/instanced_scene.h"
#include "support/render_replicates.h"

#include "render/bench_meshes.h"

#include <gtest/gtest.h>

namespace sundog::test
{
namespace
{

constexpr int size = 32, blocks = 4, replicates = 8;

struct Pair {
    Scene instanced, copied;
};

// A diffuse mesh with smooth normals, a glass ball and a quadrilateral seen from both sides, three times in a box: upright,
// mirrored and turned, stretched. The stretched copy has no ball, which no sphere of the world could match.
Pair scenes()
{
    Scene box = cornell_box(size);
    const uint painted = add_bsdf(box, DiffuseBsdf{{0.3f, 0.5f, 0.7f}});
    const uint glass = add_bsdf(box, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    const uint both_sides = add_bsdf(box, TwoSidedBsdf{painted, painted});
    ShapeDescription smooth;
    TriangleMesh mesh;
    add_icosphere(mesh, {0, 0, 0}, 1.0f, 2);
    mesh.normals = mesh.positions;
    smooth.geometry = mesh;
    smooth.bsdf = painted;
    ShapeDescription wing = make_quad({-2, -1, 0}, {2, -1, 0}, {2, -1, 1.5f}, {-2, -1, 1.5f}, both_sides);
    ShapeDescription ball = make_sphere({0, 1.8f, 0}, 0.8f, glass);

    const auto place = [](Double3 to, Double3 scale, double degrees) {
        return Transform::translate(to) * Transform::rotate({1, 3, 1}, degrees) * Transform::scale(scale);
    };
    const std::vector<Transform> with_ball = {place({-.5, -.5, 0}, {.25, .25, .25}, 20), place({.45, -.1, .2}, {-.2, .2, .2}, 60)};
    const std::vector<Transform> without = {place({.1, .5, -.4}, {.5, .15, .25}, -30)};

    Pair pair{box, box};
    const std::size_t first = box.shapes.size();
    pair.instanced.shapes.insert(pair.instanced.shapes.end(), {smooth, wing, ball});
    make_instances(pair.instanced, first, with_ball);
    pair.instanced.shapes.insert(pair.instanced.shapes.end(), {smooth, wing});
    make_instances(pair.instanced, first + 3, without);
    const auto copy = [&](ShapeDescription shape, const Transform& to_world) {
        if (auto* triangles = std::get_if<TriangleMesh>(&shape.geometry)) *triangles = transformed(*triangles, to_world);
        if (auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
            sphere->center = to_world.point(sphere->center);
            sphere->radius *= static_cast<float>(*to_world.uniform_scale());
        }
        pair.copied.shapes.push_back(shape);
    };
    for (const Transform& to_world : with_ball)
        for (const auto& shape : {smooth, wing, ball}) copy(shape, to_world);
    for (const auto& shape : {smooth, wing}) copy(shape, without[0]);
    return pair;
}

// Other seeds on both sides: with the same ones images differ only by the few paths that rounding turns elsewhere, too few
// for their sum to be normal. Differences of a window are independent and, as means of many paths, nearly normal: their
// mean is 0 within Student's quantile, at a family-wise 1% (Bonferroni, two-sided).
void expect_same_images(const RenderRequest& request)
{
    const Pair pair = scenes();
    std::vector<std::vector<double>> differences(blocks * blocks + 1);
    std::vector<double> levels(differences.size());
    for (int seed = 1; seed <= replicates; seed++) {
        const Image a = render_sampled(pair.instanced, request, seed), b = render_sampled(pair.copied, request, 1000 + seed);
        constexpr int step = size / blocks;
        for (int w = 0; w <= blocks * blocks; w++) {
            const int x = w % blocks * step, y = w / blocks * step;
            const auto mean = [&](const Image& image) { return w == blocks * blocks ? image_mean(image) : window_mean(image, x, y, x + step, y + step); };
            const auto index = static_cast<std::size_t>(w);
            differences[index].push_back(mean(a) - mean(b));
            levels[index] += mean(b) / replicates;
        }
    }
    const double quantile = student_quantile(replicates - 1, 0.005 / static_cast<double>(differences.size()));
    for (std::size_t w = 0; w < differences.size(); w++) {
        const Estimate estimate = estimate_from(differences[w]);
        EXPECT_NEAR(estimate.mean, 0.0, quantile * estimate.standard_error) << "window " << w;
        EXPECT_LT(estimate.standard_error, 0.05 * allowed_noise() * levels[w]) << "the test has power in window " << w;
    }
}

TEST(Instances, PathsSeeCopies)
{
    expect_same_images({"path", 256, {{"max_depth", "8"}}});
}

TEST(Instances, PhotonsSeeCopies)
{
    expect_same_images({"sppm", 8, {{"max_depth", "8"}, {"photons", "8192"}, {"radius", "0.05"}}});
}

TEST(Instances, LightTracingSeesCopies)
{
    expect_same_images({"ptracer", 8, {{"max_depth", "8"}, {"photons", "16384"}}});
}

// A moved instance, and another group under it, are another scene.
TEST(Instances, FingerprintKnowsThem)
{
    const auto print = [](const Scene& scene) { return fingerprint(flatten_scene(scene), make_camera(scene.sensor, scene.film), make_pixel_filter(scene.film.filter)); };
    const Scene scene = scenes().instanced;
    Scene moved = scene, other = scene;
    moved.instances[1].to_world = Transform::translate({1e-3, 0, 0}) * moved.instances[1].to_world.at(0);
    other.instances[0].group = 1;
    EXPECT_EQ(print(scene), print(scene));
    EXPECT_NE(print(scene), print(moved));
    EXPECT_NE(print(scene), print(other));
}

} // namespace
} // namespace sundog::test
