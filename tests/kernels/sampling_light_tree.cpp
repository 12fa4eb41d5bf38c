// The tree that next-event estimation chooses lights by: choices follow the chances that are computed for them, no light
// that shines at a point is without one, and the words of a random number are dealt out exactly.
#include "scene/light_tree.h"
#include "stages/device_scene.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"
#include "support/many_lights.h"
#include "support/plain_lights.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace sundog
{
namespace
{

constexpr int tests_in_file = 24;
constexpr uint samples = 200'000;

// Where light arrives.
struct Receiver {
    Vec3 position;
    Vec3 normal;
    uint both_sides = 0; // 2: no normal at all
};

class LightTree : public DeviceFixture
{
protected:
    struct Choices {
        std::vector<uint> lights;
        std::vector<float> probabilities;
    };

    Choices choose(const DeviceScene& scene, const Receiver& receiver)
    {
        const Kernel kernel = test_kernel(R"(
            #include "scene/lights.h"
            __kernel void test(SURFACE_PARAMETERS, Vec3 position, Vec3 normal, uint both_sides, uint count, __global uint* chosen, __global float* probabilities)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const SurfaceView scene = SURFACE_VIEW;
                const uint horizon = both_sides == 2u ? 0u : pack_horizon(unpack(normal), both_sides != 0u);
                const LightChoice choice = choose_light(&scene, unpack(position), horizon, random_words(i, 31u).z);
                chosen[i] = choice.light;
                probabilities[i] = choice.probability;
            })",
                                          scene.surface_options());
        const auto chosen = allocate<uint>(samples);
        const auto probabilities = allocate<float>(samples);
        kernel(samples, scene.surfaces(), receiver.position, receiver.normal, receiver.both_sides, samples, chosen, probabilities);
        return {chosen.download(), probabilities.download()};
    }

    // Of every light.
    std::vector<float> chances(const DeviceScene& scene, const Receiver& receiver, std::size_t lights)
    {
        const Kernel kernel = test_kernel(R"(
            #include "scene/lights.h"
            __kernel void test(SURFACE_PARAMETERS, Vec3 position, Vec3 normal, uint both_sides, uint count, __global float* probabilities)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const SurfaceView scene = SURFACE_VIEW;
                const uint horizon = both_sides == 2u ? 0u : pack_horizon(unpack(normal), both_sides != 0u);
                probabilities[i] = light_probability(&scene, i, unpack(position), horizon);
            })",
                                          scene.surface_options());
        const uint count = static_cast<uint>(lights);
        const auto probabilities = allocate<float>(count);
        kernel(count, scene.surfaces(), receiver.position, receiver.normal, receiver.both_sides, count, probabilities);
        return probabilities.download();
    }
};

// In and among the lights, and far off; on one side, on both, and in the open.
std::vector<Receiver> receivers(uint seed)
{
    RandomNumbers random(seed);
    std::vector<Receiver> list;
    for (uint i = 0; i < 6; ++i) list.push_back({random.point(i < 4 ? 10.0f : 60.0f), random.direction(), i % 3});
    return list;
}

TEST_F(LightTree, ChoicesFollowTheirChances)
{
    for (const bool distant : {false, true}) {
        const Scene host = many_lights(203, distant ? 5 : 6, distant);
        const DeviceScene scene(device_, host, false, LightSelection::tree);
        const std::size_t lights = flatten_scene(host).lights.size();
        for (const Receiver& receiver : receivers(distant ? 1 : 2)) {
            const std::vector<float> chance = chances(scene, receiver, lights);
            const Choices drawn = choose(scene, receiver);
            std::vector<double> counts(lights + 1, 0.0), expected(chance.begin(), chance.end());
            for (std::size_t i = 0; i < samples; ++i) {
                counts[std::min<std::size_t>(drawn.lights[i], lights)] += 1.0;
                if (drawn.lights[i] != NO_LIGHT) {
                    ASSERT_NEAR(drawn.probabilities[i], chance[drawn.lights[i]], 1e-5 * chance[drawn.lights[i]]);
                }
            }
            // What is left goes to branches that look lit only from above.
            const double sum = std::accumulate(expected.begin(), expected.end(), 0.0);
            ASSERT_LE(sum, 1.0 + 1e-5);
            EXPECT_GT(sum, 0.05);
            expected.push_back(std::max(0.0, 1.0 - sum));
            if (receiver.both_sides == 2 && sum > 1.0 - 1e-5) expected.back() = 0.0;
            for (double& e : expected) e *= samples;
            if (expected.back() < 1e-5 * samples && counts.back() <= 3.0) counts.back() = expected.back() = 0.0; // rounding of the sum
            EXPECT_TRUE(follows(counts, expected, tests_in_file));
        }
    }
}

// Whether some point of a light sends light to a receiver.
bool shines_at(const FlatScene& flat, const Light& light, const Receiver& receiver)
{
    Doubt doubt;
    const Vec3d position = receiver.position, normal = receiver.normal;
    const auto arrives = [&](Vec3d from) {
        const double cosine = dot(normalized(from - position), normal);
        return receiver.both_sides != 0 || cosine > 1e-4;
    };
    const Vec3d way = position - Vec3d(light.position);
    switch (light.type) {
    case LIGHT_POINT:
        return arrives(light.position);
    case LIGHT_SPOT:
        return arrives(light.position) && plain_spot_falloff(light, dot(normalized(way), Vec3d(light.direction)), doubt) > 1e-4;
    case LIGHT_PROJECTOR: {
        const LightProjection& image = flat.light_projections[light.primitive];
        const double depth = dot(way, Vec3d(light.direction));
        return arrives(light.position) && depth > 0.0 && std::abs(dot(way, Vec3d(image.axis_x))) < depth * image.half_width &&
               std::abs(dot(way, Vec3d(image.axis_y))) < depth * image.half_height;
    }
    case LIGHT_DIRECTIONAL:
    case LIGHT_CONSTANT:
        return true;
    default:
        break;
    }
    for (int i = 0; i < 64; ++i) {
        const Pair u{(i % 8 + 0.5) / 8, (i / 8 + 0.5) / 8};
        PlainLightPoint point{};
        if (light.type == LIGHT_CYLINDER) {
            const AnalyticPrimitive& cylinder = flat.analytics.at(light.primitive - ANALYTIC_BIT);
            const double angle = 2.0 * pi * u[0];
            point.normal = Vec3d(cylinder.axis_u) * std::cos(angle) + Vec3d(cylinder.axis_v) * std::sin(angle);
            point.position =
                Vec3d(cylinder.center) + Vec3d(cylinder.normal) * (u[1] * cylinder.length) + point.normal * double(cylinder.radius);
        } else {
            point = plain_light_point(flat, light, u);
        }
        if (arrives(point.position) && dot(normalized(position - point.position), point.normal) > 1e-4) return true;
    }
    return false;
}

TEST_F(LightTree, NoLightThatShinesIsLeftOut)
{
    const Scene host = many_lights(700, 9, true);
    const FlatScene flat = flatten_scene(host);
    const DeviceScene scene(device_, host, false, LightSelection::tree);
    RandomNumbers random(3);
    std::size_t shining = 0, dark = 0;
    for (int r = 0; r < 40; ++r) {
        // Also on the lights themselves and just beside them.
        const Light& beside = flat.lights[static_cast<std::size_t>(r) * 17];
        const bool near = r % 2 == 0 && !LIGHT_IS_DELTA(beside.type) && beside.type == LIGHT_TRIANGLE;
        const Vec3 position =
            near ? flat.positions[flat.triangles[beside.primitive].vertex[0]] + random.direction() * 0.01f : random.point(12.0f);
        const Receiver receiver{position, random.direction(), static_cast<uint>(r % 3)};
        const std::vector<float> chance = chances(scene, receiver, flat.lights.size());
        for (std::size_t i = 0; i < flat.lights.size(); ++i) {
            if (shines_at(flat, flat.lights[i], receiver)) {
                EXPECT_GT(chance[i], 0.0f) << "light " << i << " of type " << flat.lights[i].type << " at receiver " << r;
                ++shining;
            } else {
                dark += chance[i] == 0.0f;
            }
        }
    }
    EXPECT_GT(shining, 5000u);
    EXPECT_GT(dark, 5000u) << "lights that face away, or lie behind, are not chosen";
}

// A choice would be lost: no point sees it.
TEST_F(LightTree, CollimatedBeamsAreNotChosen)
{
    SceneBuilder builder;
    builder.shape(Sphere{{0, 0, -9}, 0.1f})
        .emitter(CollimatedEmitter{{0, 0, 0}, {0, 0, 1}, {1000, 0, 0}})
        .emitter(PointEmitter{{1, 0, 0}, {1, 1, 1}})
        .emitter(PointEmitter{{0, 1, 0}, {1, 1, 1}});
    const DeviceScene scene(device_, builder.scene, false, LightSelection::tree);
    const std::vector<float> chance = chances(scene, {{0, 0, 4}, {0, 0, -1}, 0}, 3);
    EXPECT_EQ(chance[0], 0.0f);
    EXPECT_NEAR(chance[1] + chance[2], 1.0f, 1e-6f);
}

// A spot that does not fade: full light up to the cut-off's rim, where bounds are tight.
TEST_F(LightTree, RimsOfSpotsAndEdgesOfHorizonsAreInside)
{
    SceneBuilder builder;
    builder.shape(Sphere{{0, 0, -9}, 0.1f})
        .emitter(SpotEmitter{{0, 0, 0}, {0, 0, 1}, {1, 1, 1}, 0.3f, 0.3f})
        .emitter(PointEmitter{{0, 0, 0}, {1, 1, 1}});
    const DeviceScene scene(device_, builder.scene, false, LightSelection::tree);
    for (const float angle : {0.2999f, 0.29999f}) {
        const Receiver rim{{1000.0f * std::sin(angle), 0, 1000.0f * std::cos(angle)}, {0, 0, -1}, 0};
        EXPECT_GT(chances(scene, rim, 2)[0], 0.1f);
    }
    const Receiver grazing{{0.05f, 0, 1}, normalize(Vec3{1.0f, 0, 0.05f - 1e-5f}), 0};
    for (const float chance : chances(scene, grazing, 2)) EXPECT_GE(chance, 0.0f);
}

// Walking through all words finds each light's own, which must be as many as its chance says: with the 24 bits of a float
// the shares of 10^5 lights were wrong by a percent.
class LightWords : public LightTree
{
protected:
    // How many words choose each of some lights, as a part of all. order: rank of each light among words.
    std::vector<double> shares(const DeviceScene& scene, const std::vector<uint>& order, const std::vector<uint>& ranks, Vec3 position,
                               const char* choose)
    {
        const Kernel kernel = test_kernel(std::string(R"(
            #include "scene/lights.h"
            __kernel void test(SURFACE_PARAMETERS, Vec3 position, uint count, __global const uint* order, __global const uint* ranks, __global uint* firsts)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const SurfaceView scene = SURFACE_VIEW;
                uint low = 0u; // bisection for the first word of a rank
                for (uint step = 0x80000000u; step; step >>= 1) {
                    const LightChoice choice = )") +
                                              choose + R"(;
                    if (order[choice.light] < ranks[i]) low += step;
                }
                firsts[i] = low;
            })",
                                          scene.surface_options());
        const uint count = static_cast<uint>(ranks.size());
        const auto firsts = allocate<uint>(count);
        kernel(count, scene.surfaces(), position, count, upload(order), upload(ranks), firsts);
        std::vector<double> result;
        const auto found = firsts.download();
        for (std::size_t i = 0; i + 1 < found.size(); i += 2)
            result.push_back((static_cast<double>(found[i + 1]) - found[i]) / 4294967296.0);
        return result;
    }

    static constexpr uint lights = 100'000;
    static Scene scene_of_equal_lights()
    {
        RandomNumbers random(4);
        SceneBuilder builder;
        builder.shape(Sphere{{0, 0, -11}, 0.1f});
        for (uint i = 0; i < lights; ++i) builder.emitter(PointEmitter{random.point(10.0f), {1, 1, 1}});
        return builder.scene;
    }
};

TEST_F(LightWords, OfTheAliasTableAreEven)
{
    const DeviceScene scene(device_, scene_of_equal_lights(), false, LightSelection::power);
    std::vector<uint> order(lights), ranks;
    std::iota(order.begin(), order.end(), 0u);
    for (uint i = 0; i < 400; ++i)
        for (const uint rank : {i * 249 + 7, i * 249 + 8}) ranks.push_back(rank);
    // 42949.67 words for each light.
    for (const double share : shares(scene, order, ranks, {0, 0, 0}, "choose_light_by_power(&scene, low + step - 1u)"))
        EXPECT_NEAR(share * lights, 1.0, 1.01 * lights / 4294967296.0);
}

TEST_F(LightWords, OfTheTreeAreAsItsChances)
{
    const Scene host = scene_of_equal_lights();
    const DeviceScene scene(device_, host, false, LightSelection::tree);
    const std::vector<LightNode> nodes = build_light_tree(flatten_scene(host));
    std::vector<uint> order(lights), in_order;
    std::vector<uint> stack{lights};
    while (!stack.empty()) {
        const uint node = stack.back();
        stack.pop_back();
        if (node < lights) {
            order[node] = static_cast<uint>(in_order.size());
            in_order.push_back(node);
        } else {
            stack.push_back(nodes[node].second);
            stack.push_back(nodes[node].first);
        }
    }
    ASSERT_EQ(in_order.size(), lights);
    std::vector<uint> ranks;
    for (uint i = 0; i < 400; ++i)
        for (const uint rank : {i * 249 + 7, i * 249 + 8}) ranks.push_back(rank);
    const Vec3 position{1, 2, 3};
    const auto found = shares(scene, order, ranks, position, "choose_light(&scene, unpack(position), 0u, low + step - 1u)");
    const std::vector<float> chance = chances(scene, {position, {0, 0, 1}, 2}, lights);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double expected = chance[in_order[ranks[2 * i]]];
        EXPECT_NEAR(found[i], expected, 2e-5 * expected + 20.0 / 4294967296.0) << i; // a word lost a level at most
    }
}

TEST_F(LightTree, NormalsSurviveTheirPacking)
{
    const Kernel kernel = test_kernel(R"(
        #include "scene/horizon.h"
        #include "math/warp.h"
        __kernel void test(uint count, __global Vec3* normals, __global Vec3* unpacked, __global uint* again)
        {
            uint i = get_global_id(0);
            if (i >= count) return;
            float3 normal = sample_sphere(random4(i, 8u).xy);
            if (i < 6u) normal = (float3)(i == 0u ? 1.0f : i == 1u ? -1.0f : 0.0f, i == 2u ? 1.0f : i == 3u ? -1.0f : 0.0f, i == 4u ? 1.0f : i == 5u ? -1.0f : 0.0f);
            const uint horizon = pack_horizon(normal, (i & 1u) != 0u);
            normals[i] = pack(normal);
            unpacked[i] = pack(horizon_normal(horizon));
            again[i] = (horizon & HORIZON_HAS_NORMAL) && ((horizon & HORIZON_BOTH_SIDES) != 0u) == ((i & 1u) != 0u);
        })");
    const auto normals = allocate<Vec3>(samples), unpacked = allocate<Vec3>(samples);
    const auto again = allocate<uint>(samples);
    kernel(samples, samples, normals, unpacked, again);
    const auto a = normals.download(), b = unpacked.download();
    const auto flags = again.download();
    for (std::size_t i = 0; i < samples; ++i) {
        ASSERT_NEAR(length(Vec3d(a[i]) - normalized(Vec3d(b[i]))), 0.0, 2e-4) << a[i].x << " " << a[i].y << " " << a[i].z;
        ASSERT_EQ(flags[i], 1u);
    }
}

// A town of 2500 lamps, most of them far from a point: the tree's estimate is less noisy than power's by much.
TEST_F(LightTree, LessNoiseThanByPower)
{
    RandomNumbers random(12);
    SceneBuilder builder;
    builder.shape(Sphere{{0, 0, -1}, 0.1f});
    for (int i = 0; i < 2500; ++i) {
        const float x = static_cast<float>(2 * (i % 50) - 49), y = static_cast<float>(2 * (i / 50) - 49);
        builder.emitter(PointEmitter{Vec3{x, y, 1.5f} + random.point(0.5f), {1, 1, 1}});
    }
    const Scene& host = builder.scene;
    const auto irradiance = [&](LightSelection selection) {
        const DeviceScene scene(device_, host, false, selection);
        const Kernel kernel = test_kernel(R"(
            #include "scene/lights.h"
            __kernel void test(SURFACE_PARAMETERS, Vec3 position, Vec3 normal, uint count, __global float* values)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const SurfaceView scene = SURFACE_VIEW;
                Surface surface;
                surface.position = unpack(position);
                surface.geometric_normal = surface.shading_normal = surface.outgoing = unpack(normal);
                surface.offset = 1e-5f;
                surface.shape = surface.primitive = 0u;
                LightSample sample;
                values[i] = 0.0f;
                if (sample_light(&scene, &surface, LIGHT_TREE ? pack_horizon(unpack(normal), false) : 0u, random_words(i, 33u), &sample))
                    values[i] = sample.radiance.x * fmax(0.0f, dot(sample.direction, unpack(normal)));
            })",
                                          scene.surface_options());
        const auto values = allocate<float>(samples);
        kernel(samples, scene.surfaces(), Vec3{3, -2, 0}, Vec3{0, 0, 1}, samples, values);
        double sum = 0.0, squares = 0.0;
        for (const float value : values.download()) {
            sum += static_cast<double>(value);
            squares += static_cast<double>(value) * static_cast<double>(value);
        }
        const double mean = sum / samples;
        return std::pair{mean, squares / samples - mean * mean};
    };
    const auto [by_tree, tree_variance] = irradiance(LightSelection::tree);
    const auto [by_power, power_variance] = irradiance(LightSelection::power);
    EXPECT_NEAR(by_tree, by_power, 4.5 * std::sqrt((tree_variance + power_variance) / samples));
    EXPECT_LT(tree_variance, 0.1 * power_variance);
}

} // namespace
} // namespace sundog
