// Lights as the device sees them: areas, powers, the alias table; and pixel filter tables.
#include "base/errors.h"
#include "scene/flat_scene.h"
#include "scene/light_list.h"
#include "support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace sundog
{
namespace
{

using std::numbers::pi;

TEST(AliasTable, ColumnsAddUpToTheWeights)
{
    std::mt19937 random(1);
    for (const std::size_t n : {1u, 2u, 3u, 10u, 1000u, 100'000u}) {
        std::vector<double> weights(n);
        for (double& w : weights) w = random() % 5 == 0 ? 0.0 : std::pow(10.0, static_cast<double>(random() % 9));
        weights[n / 2] = 1e6;
        const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
        std::vector<float> probabilities;
        const std::vector<AliasEntry> table = make_alias_table(weights, probabilities);
        ASSERT_EQ(table.size(), n);
        ASSERT_EQ(probabilities.size(), n);
        std::vector<double> chance(n, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            const double threshold = table[i].threshold;
            ASSERT_TRUE(threshold >= 0.0 && threshold <= 1.0);
            ASSERT_LT(table[i].alias, n);
            chance[i] += threshold / static_cast<double>(n);
            chance[table[i].alias] += (1.0 - threshold) / static_cast<double>(n);
        }
        for (std::size_t i = 0; i < n; ++i) {
            // A column's threshold is a float: its error is 2^-24 of a column.
            ASSERT_NEAR(chance[i], weights[i] / total, 1e-7 * (1.0 / static_cast<double>(n) + weights[i] / total)) << i << " of " << n;
            ASSERT_NEAR(probabilities[i], weights[i] / total, 1e-7 * weights[i] / total);
            if (weights[i] == 0.0) {
                ASSERT_EQ(chance[i], 0.0) << "a light without power can be chosen";
            }
        }
    }
}

double power(const FlatScene& flat, std::size_t light) // as a fraction
{
    return flat.lights.at(light).probability;
}

TEST(FlatSceneLights, AreasAndPowers)
{
    const FlatScene flat = flatten_scene(SceneBuilder()
                                             .shape(Sphere{{0, 0, 0}, 1.0f, false})
                                             .light(parallelogram({0, 0, 5}, {2, 0, 0}, {0, 3, 0}), {1, 2, 0.5f})
                                             .light(Sphere{{0, 0, 9}, 0.5f, false}, {4, 0, 0})
                                             .light(Disk{{0, 9, 0}, {2, 0, 0}, {1, 3, 0}}, {1, 1, 1}) // skewed half axes
                                             .emitter(PointEmitter{{0, 0, 0}, {3, 3, 3}})
                                             .emitter(DirectionalEmitter{{0, 0, -1}, {0.5f, 0.5f, 0.5f}})
                                             .emitter(ConstantEmitter{{0.25f, 0.25f, 0.25f}})
                                             .emitter(SpotEmitter{{0, 0, 0}, {0, 0, 1}, {2, 2, 2}, 0.5f, 0.5f})
                                             .scene);
    ASSERT_EQ(flat.lights.size(), 8u); // two triangles
    ASSERT_EQ(flat.light_alias.size(), 8u);
    EXPECT_EQ(flat.globals.light_count, 8u);
    EXPECT_EQ(flat.globals.environment_light, 6u);
    EXPECT_EQ(flat.shapes[0].first_light, NO_LIGHT);
    EXPECT_EQ(flat.shapes[1].first_light, 0u);
    EXPECT_EQ(flat.shapes[2].first_light, 2u);
    EXPECT_EQ(flat.shapes[3].first_light, 3u);
    EXPECT_EQ(flat.lights[1].primitive, flat.shapes[1].first_primitive + 1);
    EXPECT_EQ(flat.lights[2].primitive, ANALYTIC_BIT | 1u);

    EXPECT_FLOAT_EQ(flat.lights[0].area, 3.0f);
    EXPECT_FLOAT_EQ(flat.lights[1].area, 3.0f);
    EXPECT_FLOAT_EQ(flat.lights[2].area, static_cast<float>(pi));
    EXPECT_FLOAT_EQ(flat.lights[3].area, static_cast<float>(pi * 6.0));

    const double disk = pi * flat.globals.radius * flat.globals.radius;
    const double powers[] = {pi * 3 * 2, pi * 3 * 2, pi * pi * 4,          pi * pi * 6,
                             4 * pi * 3, disk * 0.5, 4 * pi * disk * 0.25, 2 * pi * (1 - std::cos(0.5)) * 2};
    const double total = std::accumulate(std::begin(powers), std::end(powers), 0.0);
    // Seven emitters: the two triangles are one.
    for (std::size_t i = 0; i < 8; ++i) {
        const double floor = emitter_floor / 7.0 * (i < 2 ? 0.5 : 1.0);
        EXPECT_NEAR(power(flat, i), (1.0 - emitter_floor) * powers[i] / total + floor, 1e-5) << "light " << i;
    }
}

// 10^4 triangles do not take the floor from a lamp that is 10^9 times weaker, nor do they count as many.
TEST(FlatSceneLights, AWeakEmitterHasItsShare)
{
    TriangleMesh mesh;
    for (uint i = 0; i < 10'000; ++i) {
        const float x = static_cast<float>(i);
        for (const Vec3 p : {Vec3{x, 0, 0}, Vec3{x + 1, 0, 0}, Vec3{x, 1, 0}}) mesh.positions.push_back(p);
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const FlatScene flat = flatten_scene(SceneBuilder().light(mesh, {1, 1, 1}).emitter(PointEmitter{{0, 0, 9}, {1e-6f, 0, 0}}).scene);
    EXPECT_NEAR(power(flat, 10'000), 0.5 * emitter_floor, 1e-6);
    double sum = 0.0;
    for (const Light& light : flat.lights) sum += light.probability;
    EXPECT_NEAR(sum, 1.0, 1e-5);
}

TEST(FlatSceneLights, AnEllipsesAreaDoesNotDependOnItsAxes)
{
    // Half axes a cos t + b sin t, and its conjugate, span the same ellipse for every t.
    for (const float t : {0.0f, 0.3f, 1.0f, 2.0f}) {
        const Vec3 u{2.0f * std::cos(t), 0.5f * std::sin(t), 0}, v{-2.0f * std::sin(t), 0.5f * std::cos(t), 0};
        const FlatScene flat = flatten_scene(SceneBuilder().light(Disk{{0, 0, 0}, u, v}, {1, 1, 1}).scene);
        EXPECT_NEAR(flat.lights[0].area, pi * 2.0 * 0.5, 1e-5) << t;
        EXPECT_NEAR(flat.analytics[0].normal.z, 1.0f, 1e-6f);
    }
}

TEST(FlatSceneLights, WithoutPowerThereIsNothingToRender)
{
    EXPECT_THROW(flatten_scene(SceneBuilder().shape(Sphere{}).scene), SceneError);
    EXPECT_THROW(flatten_scene(SceneBuilder().shape(Sphere{}).emitter(PointEmitter{{0, 0, 0}, {0, 0, 0}}).scene), SceneError);
    // A degenerate triangle beside a good one is never chosen.
    TriangleMesh mesh = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.triangles.push_back({0, 0, 1});
    const FlatScene flat = flatten_scene(SceneBuilder().light(mesh, {1, 1, 1}).scene);
    EXPECT_EQ(power(flat, 2), 0.0);
    EXPECT_EQ(flat.light_alias[2].threshold, 0.0f);
}

TEST(PixelFilterTable, IsNormalised)
{
    const std::vector<ReconstructionFilter> filters = {{FilterKind::box, 0.5f, 0.5f, 0.0f, 0.0f},
                                                       {FilterKind::box, 1.7f, 0.5f, 0.0f, 0.0f},
                                                       {FilterKind::tent, 1.0f, 0.5f, 0.0f, 0.0f},
                                                       {FilterKind::gaussian, 2.0f, 0.5f, 0.0f, 0.0f},
                                                       {FilterKind::mitchell, 2.0f, 0.5f, 1.0f / 3.0f, 1.0f / 3.0f},
                                                       {FilterKind::mitchell, 2.0f, 0.5f, 0.0f, 0.5f},
                                                       {FilterKind::lanczos, 3.0f, 0.5f, 0.0f, 0.0f}};
    for (const ReconstructionFilter& filter : filters) {
        SCOPED_TRACE(static_cast<int>(filter.kind));
        const PixelFilter table = make_pixel_filter(filter);
        const double bin = 2.0 * filter.radius / FILTER_BINS;
        double integral = 0.0, weighted = 0.0;
        EXPECT_EQ(table.cdf[0], 0.0f);
        EXPECT_EQ(table.cdf[FILTER_BINS], 1.0f);
        for (int i = 0; i < FILTER_BINS; ++i) {
            EXPECT_GE(table.cdf[i + 1], table.cdf[i]);
            EXPECT_NEAR(table.density[i], table.density[FILTER_BINS - 1 - i], 1e-5f) << "symmetric";
            const double probability = static_cast<double>(table.cdf[i + 1]) - table.cdf[i];
            EXPECT_NEAR(probability * table.sign_scale[i], table.density[i] * bin, 1e-6) << "a bin's weight times its probability";
            integral += table.density[i] * bin;
            weighted += probability * table.sign_scale[i];
        }
        EXPECT_NEAR(integral, 1.0, 1e-6);
        EXPECT_NEAR(weighted, 1.0, 1e-6);
    }
}

// Shapes at chosen points, normalised here by the known integrals.
TEST(PixelFilterTable, HasTheFiltersShape)
{
    const PixelFilter tent = make_pixel_filter({FilterKind::tent, 1.0f, 0.5f, 0.0f, 0.0f});
    EXPECT_NEAR(tent.density[FILTER_BINS / 2], 1.0 - 0.5 * 2.0 / FILTER_BINS, 1e-3); // just beside the centre
    EXPECT_NEAR(tent.density[FILTER_BINS / 4], 0.5 + 0.5 * 2.0 / FILTER_BINS, 1e-3);

    // Mitchell with B = C = 1/3 and radius 2 integrates to 1: 8/9 - 2 x^2 + 7/6 |x|^3 about 0, 1/18 at 1, negative beyond 1.2.
    const PixelFilter mitchell = make_pixel_filter({FilterKind::mitchell, 2.0f, 0.5f, 1.0f / 3.0f, 1.0f / 3.0f});
    EXPECT_NEAR(mitchell.density[FILTER_BINS / 2], 8.0 / 9.0 - 2.0 / 3.0 / 256.0 + 7.0 / 24.0 / 4096.0, 2e-4);
    EXPECT_NEAR(0.5 * (mitchell.density[FILTER_BINS / 4] + mitchell.density[FILTER_BINS / 4 - 1]), 1.0 / 18.0, 2e-3);
    EXPECT_LT(mitchell.density[FILTER_BINS / 8], 0.0f);

    // Zero at whole numbers, negative between 1 and 2: sinc(1.5) sinc(0.5) = -4 / (3 pi^2) of the height.
    const PixelFilter lanczos = make_pixel_filter({FilterKind::lanczos, 3.0f, 0.5f, 0.0f, 0.0f});
    EXPECT_NEAR(0.5 * (lanczos.density[FILTER_BINS / 4] + lanczos.density[FILTER_BINS / 4 - 1]) / lanczos.density[FILTER_BINS / 2], -4.0 / (3.0 * pi * pi),
                2e-3);

    const PixelFilter gaussian = make_pixel_filter({FilterKind::gaussian, 2.0f, 0.5f, 0.0f, 0.0f});
    const double edge = std::exp(-8.0); // lowered to reach 0 at the radius
    EXPECT_NEAR(gaussian.density[FILTER_BINS / 4] / gaussian.density[FILTER_BINS / 2],
                (std::exp(-2.0 * std::pow(1.0 - 1.0 / 32.0, 2)) - edge) / (std::exp(-2.0 / (32.0 * 32.0)) - edge), 2e-3);
    EXPECT_NEAR(gaussian.density[0], 0.0f, 1e-3f);
}

} // namespace
} // namespace sundog
