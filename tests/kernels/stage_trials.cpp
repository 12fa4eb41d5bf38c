// Bernoulli trials: their estimate of 1 / P has that mean, whatever bound they were made with and however they were dealt out.
#include "shared/bidirectional.h"
#include "shared/trials.h"
#include "stages/device_scene.h"
#include "stages/sampling.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"
#include "support/scene_builder.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace sundog
{
namespace
{

constexpr uint replicates = 20'000;
constexpr PathRules rules{UNBOUNDED_DEPTH, 2};

Scene floor_scene()
{
    SceneBuilder builder;
    builder.shape(parallelogram({-20, -20, 0}, {40, 0, 0}, {0, 40, 0}));
    builder.bsdf(ConductorBsdf{{0.2f, 0.2f, 0.2f}, {4, 4, 4}, {}, Roughness{false, 0.3f, 0.3f}}); // so that its lobe is compiled
    builder.shape(parallelogram({-20, -20, 50}, {0, 40, 0}, {40, 0, 0}), 1);
    builder.emitter(PointEmitter{{0, 0, 25}, {1, 1, 1}});
    return builder.scene;
}

// At height 1 over the floor, looking down.
PathVertex vertex_above_floor(uint depth)
{
    PathVertex vertex{};
    vertex.position = {0, 0, 1};
    vertex.offset = 4e-6f;
    vertex.throughput = {1, 1, 1};
    vertex.depth = depth;
    vertex.eta_scale = 1.0f;
    vertex.lobe.lobe = LOBE_DIFFUSE;
    vertex.lobe.reflectance = {0.5f, 0.5f, 0.5f};
    vertex.lobe.normal = vertex.lobe.geometric_normal = vertex.lobe.shading_normal = {0, 0, -1};
    vertex.lobe.tangent = {1, 0, 0};
    vertex.lobe.outgoing = {0.6f, 0, -0.8f};
    return vertex;
}

PathVertex glossy_vertex_above_floor(uint depth, float alpha)
{
    PathVertex vertex = vertex_above_floor(depth);
    vertex.lobe.lobe = LOBE_ROUGH_CONDUCTOR;
    vertex.lobe.alpha_u = vertex.lobe.alpha_v = alpha;
    vertex.lobe.reflectance = {0.8f, 0.8f, 0.8f};
    vertex.lobe.eta_rgb = {0.2f, 0.2f, 0.2f};
    vertex.lobe.k_rgb = {4, 4, 4};
    return vertex;
}

// Chance that a cosine-distributed ray from height 1 meets the disk of the given radius around a point of the floor: the midpoint
// rule for cos^2 / (pi d^2), which is 1 / (pi (1 + rho^2)^2).
double chance_of_disk(double distance, double radius)
{
    constexpr int steps = 400;
    double sum = 0.0;
    for (int i = 0; i < steps; i++)
        for (int j = 0; j < steps; j++) {
            const double r = radius * (i + 0.5) / steps, phi = 2 * std::numbers::pi * (j + 0.5) / steps;
            const double x = distance + r * std::cos(phi), y = r * std::sin(phi);
            sum += r / std::pow(1 + x * x + y * y, 2);
        }
    return sum * radius / steps * 2 / steps;
}

struct Reciprocal {
    double mean = 0.0, standard_error = 0.0;
    double trials = 0.0; // for each
    std::vector<TrialState> states;
};

class Trials : public DeviceFixture
{
protected:
    // Trials for the ball around a point of the floor. bound: instead of the one that would be chosen, if not negative.
    Reciprocal reciprocal(const PathVertex& vertex, float distance, float radius, float bound = -1.0f, uint per_pair = 1)
    {
        PathVertex center{};
        center.position = {distance, 0, 0};
        const auto light_vertices = upload(std::vector{center});
        const auto camera_vertices = upload(std::vector<PathVertex>(replicates, vertex));
        std::vector<VertexPair> pair_list;
        for (uint i = 0; i < replicates; i++) pair_list.push_back({i, 0});
        const auto pairs = upload(pair_list);
        const auto occluded = upload(std::vector<uint>(replicates, 0));
        const auto radiance = upload(std::vector<Vec3>(replicates, {1, 1, 1}));
        const auto paths = upload(std::vector<PathState>(replicates, PathState{}));
        const auto flags = allocate<uint>(replicates);
        auto states = allocate<TrialState>(replicates);
        Kernel(device_, "begin_trials", "Begin", scene_.surface_options())(replicates, radius, replicates, pairs, camera_vertices,
                                                                           light_vertices, paths, occluded, radiance, states, flags);
        if (bound >= 0.0f) states.upload(std::vector<TrialState>(replicates, {0, 0.0f, 1.0f, bound}));

        const Kernel propose(device_, "propose_trials", "Propose", scene_.surface_options()),
            trace(device_, "trace_closest", "Trace", scene_.trace_options()), judge(device_, "judge_trials", "Judge");
        std::vector<uint> waiting(replicates), all(replicates * per_pair);
        std::iota(waiting.begin(), waiting.end(), 0u);
        std::iota(all.begin(), all.end(), 0u);
        const auto ray_list = upload(all);
        const auto rays = allocate<Ray>(all.size());
        const auto hits = allocate<Hit>(all.size());
        const auto trials = allocate<Trial>(all.size());
        while (!waiting.empty()) {
            const uint count = static_cast<uint>(waiting.size());
            const auto list = upload(waiting), ray_count = upload(std::vector<uint>{count * per_pair});
            propose(count * per_pair, key_, rules, radius, count, per_pair, list, pairs, camera_vertices, light_vertices, states,
                    rays, trials);
            trace(count * per_pair, scene_.geometry(), rays, hits, ray_list, ray_count);
            judge(count, radius, count, per_pair, list, pairs, light_vertices, rays, hits, trials, states, flags);
            const auto waits = flags.download(0, count);
            std::vector<uint> next;
            for (uint i = 0; i < count; i++)
                if (waits[i] & PATH_ALIVE) next.push_back(waiting[i]);
            waiting = next;
        }
        return summary(states.download(), vertex, distance, radius);
    }

    static Reciprocal summary(std::vector<TrialState> states, const PathVertex& vertex, double distance, double radius)
    {
        const double reach = radius + 2.0 * double(vertex.offset), sine_squared = reach * reach / (1 + distance * distance);
        const double solid_angle = 2 * std::numbers::pi * (1 - std::sqrt(1 - sine_squared));
        Reciprocal result;
        double squares = 0.0;
        for (const TrialState& state : states) {
            const double value = state.bound > 0.0f ? double(state.sum) / solid_angle : double(state.sum);
            result.mean += value / replicates;
            squares += value * value / replicates;
            result.trials += double(state.count) / replicates;
        }
        result.standard_error = std::sqrt((squares - result.mean * result.mean) / replicates);
        result.states = std::move(states);
        return result;
    }

    static void expect_equal(const Reciprocal& a, double expected, double error = 0.0)
    {
        EXPECT_NEAR(a.mean, expected, 3.5 * std::hypot(a.standard_error, error));
        EXPECT_LT(a.standard_error, 0.02 * a.mean);
    }

    const SamplerKey key_ = sampler_key(3, 2);
    DeviceScene scene_{device_, floor_scene()};
};

TEST_F(Trials, OfADiffuseVertexMeetItsAnalyticChance)
{
    for (float distance : {0.0f, 1.0f}) {
        for (float radius : {0.05f, 0.2f}) {
            const double chance = chance_of_disk(double(distance), double(radius));
            const Reciprocal got = reciprocal(vertex_above_floor(1), distance, radius);
            expect_equal(got, 1 / chance);
            // The cone's bound is the density itself in all but its foreshortening: cos of the floor's normal.
            EXPECT_LT(got.trials, 2.5) << distance;
        }
    }
}

TEST_F(Trials, CountRussianRoulette)
{
    // From depth 2 on half of the paths end: reflectance 1/2.
    expect_equal(reciprocal(vertex_above_floor(2), 1.0f, 0.2f), 2 / chance_of_disk(1.0, 0.2));
    expect_equal(reciprocal(vertex_above_floor(2), 1.0f, 0.2f, 0.0f), 2 / chance_of_disk(1.0, 0.2));
}

TEST_F(Trials, ByTheLobesOwnDirectionsHaveTheSameMean)
{
    expect_equal(reciprocal(vertex_above_floor(1), 0.0f, 0.5f, 0.0f), 1 / chance_of_disk(0.0, 0.5));
}

TEST_F(Trials, OfAGlossyVertexAgreeHoweverTheyAreMade)
{
    for (float alpha : {0.1f, 0.4f}) {
        const PathVertex vertex = glossy_vertex_above_floor(2, alpha);
        const float distance = -0.75f; // where the mirror direction meets the floor
        const Reciprocal own = reciprocal(vertex, distance, 0.15f, 0.0f), cone = reciprocal(vertex, distance, 0.15f);
        expect_equal(cone, own.mean, own.standard_error);
        EXPECT_LT(cone.trials, 0.7 * own.trials) << alpha;
    }
}

// Densities beyond the bound, up to three times: weights of both signs.
TEST_F(Trials, NeedNoTrueBound)
{
    const PathVertex vertex = vertex_above_floor(1);
    const double expected = 1 / chance_of_disk(0.0, 0.2);
    for (float bound : {0.1f, 0.2f}) {
        const Reciprocal got = reciprocal(vertex, 0.0f, 0.2f, bound);
        EXPECT_NEAR(got.mean, expected, 3.5 * got.standard_error) << bound;
        EXPECT_LT(got.standard_error, 0.03 * expected) << bound;
    }
}

TEST_F(Trials, AreTheSameHoweverManyAreMadeSideBySide)
{
    const PathVertex vertex = glossy_vertex_above_floor(2, 0.1f);
    const Reciprocal one = reciprocal(vertex, -0.7f, 0.1f), many = reciprocal(vertex, -0.7f, 0.1f, -1.0f, 7);
    for (std::size_t i = 0; i < one.states.size(); i++) {
        ASSERT_EQ(one.states[i].sum, many.states[i].sum) << i;
        ASSERT_EQ(one.states[i].count, many.states[i].count) << i;
    }
}

} // namespace
} // namespace sundog
