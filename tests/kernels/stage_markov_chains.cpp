// Markov chains on a target whose integrals are known: their states follow it, weighted samples have the right means, and single
// chains are those of a plain Metropolis loop.
#include "stages/chain_radiance.h"
#include "stages/markov_chains.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"
#include "support/plain_random.h"
#include "support/render_replicates.h"

#include <cmath>

namespace sundog
{
namespace
{

// A path of one or of three vertices (u.x), as are those of light: how many numbers count depends on the first. Nothing where
// u.z < 1/4. cell() is where the sample lies, in [0, 1).
const std::string target_source = R"(
    #include "math/sampler.h"
    #include "shared/path.h"
    __kernel void test(SAMPLER_PARAMETERS, uint count, __global PathState* paths, __global float* contributions, __global float* places)
    {
        const uint i = get_global_id(0);
        if (i >= count) return;
        Sampler first = camera_sampler(SAMPLER_VIEW, i, 0u);
        const float4 u = next_4d(&first);
        paths[i].depth = u.x < 0.5f ? 3u : 1u;
        Sampler last = camera_sampler(SAMPLER_VIEW, i, paths[i].depth);
        const float v = next_4d(&last).x;
        places[i] = u.x < 0.5f ? 0.5f * v : 0.5f + 0.5f * u.y;
        contributions[i] = u.z < 0.25f ? 0.0f : u.x < 0.5f ? 3.0f * v * v : 0.5f + u.y;
    })";
constexpr double target_mean = 0.75;

// Integral of the target from place 0, over its mean.
double target_cdf(double place)
{
    const double t = 2 * place;
    return t < 1 ? 0.5 * t * t * t : 0.5 + 0.25 * ((t - 1) + (t - 1) * (t - 1));
}

struct PlainState {
    std::array<std::array<uint, 4>, 12> words{};
    uint blocks = 0;

    double number(uint vertex, std::size_t i) const { return (words[vertex * BLOCKS_PER_VERTEX][i] >> 8) * 0x1p-24; }
    bool is_long() const { return number(0, 0) < 0.5; }
    double contribution() const
    {
        if (number(0, 2) < 0.25) return 0;
        return is_long() ? 3 * number(3, 0) * number(3, 0) : 0.5 + number(0, 1);
    }
};

uint plain_hash(uint x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

class MarkovChainsOnTarget : public DeviceFixture
{
protected:
    static MarkovChainSettings settings(std::size_t chains, uint steps, double large_step, std::uint64_t seed, uint vertices = 4)
    {
        return {chains, steps, vertices, large_step, seed};
    }

    // One set of chains, and what is known of all its samples.
    struct Run {
        Run(Device& device, const Kernel& target, const MarkovChainSettings& s)
            : settings(s), chains(device, s), target_(target), paths_(device, s.chains, "paths"),
              contributions_(device, s.chains, "contributions"), places_(device, s.chains, "places")
        {
        }

        void start(std::size_t seeds)
        {
            ASSERT_TRUE(chains.start(seeds, [this]() -> const Buffer<float>& { return evaluate(); }));
            note();
        }

        void step(std::uint64_t number)
        {
            chains.propose(number);
            evaluate();
            note();
            chains.accept(contributions_);
        }

        std::vector<double> cells_of_states() const
        {
            std::vector<double> counts(32, 0.0);
            for (const MarkovChain& chain : chains.states().download())
                counts.at(static_cast<std::size_t>(places[chain.sample] * 32)) += 1.0;
            return counts;
        }

        MarkovChainSettings settings;
        MarkovChains chains;
        std::vector<float> places, contributions; // by sample

    private:
        const Buffer<float>& evaluate()
        {
            target_(settings.chains, chains.numbers(), static_cast<uint>(settings.chains), paths_, contributions_, places_);
            chains.count_used_numbers(ChainStream::camera, paths_);
            return contributions_;
        }

        void note()
        {
            for (float x : places_.download()) places.push_back(x);
            for (float x : contributions_.download()) contributions.push_back(x);
        }

        const Kernel& target_;
        Buffer<PathState> paths_;
        Buffer<float> contributions_, places_;
    };

    Kernel target_ = [this] {
        BuildOptions options;
        use_sampler(options, SamplerKind::chain);
        return test_kernel(target_source, options);
    }();
};

// Chains are independent, so that their states after any number of steps are independent samples. vertices = 2: chains do not
// keep the numbers of the third, which are independent in each proposal.
TEST_F(MarkovChainsOnTarget, StatesFollowTheTarget)
{
    constexpr int cases = 4;
    std::vector<double> expected(32);
    constexpr std::size_t chains = 1 << 15;
    for (std::size_t i = 0; i < 32; i++)
        expected[i] =
            static_cast<double>(chains) * (target_cdf(static_cast<double>(i + 1) / 32.0) - target_cdf(static_cast<double>(i) / 32.0));
    for (const auto& [large_step, steps, vertices] :
         {std::tuple{0.3, 12u, 4u}, std::tuple{0.02, 30u, 4u}, std::tuple{1.0, 8u, 4u}, std::tuple{0.02, 30u, 2u}}) {
        Run run(device_, target_, settings(chains, steps, large_step, 5, vertices));
        run.start(1 << 18);
        for (uint step = 0; step < steps; step++) run.step(step);
        EXPECT_TRUE(follows(run.cells_of_states(), expected, cases)) << "large steps " << large_step << ", vertices kept " << vertices;
    }
}

// sum of weight * contribution over samples in each cell, and so b, whatever the share of large steps: 5 cells of 4 settings.
TEST_F(MarkovChainsOnTarget, WeightedSamplesHaveTheMeansOfIndependentOnes)
{
    constexpr int replicates = 16, cells = 4;
    constexpr uint steps = 24;
    for (double large_step : {0.02, 0.3, 0.7, 1.0}) {
        std::vector<std::vector<double>> sums(cells + 1, std::vector<double>(replicates));
        for (int r = 0; r < replicates; r++) {
            Run run(device_, target_, settings(2048, steps, large_step, 100 + static_cast<std::uint64_t>(r)));
            run.start(16384);
            for (uint step = 0; step < steps; step++) run.step(step);
            const std::vector<SampleWeight> weights = run.chains.weights().download();
            for (std::size_t i = 0; i < weights.size(); i++) {
                const double value =
                    (double(weights[i].chain) * run.chains.scale() + weights[i].independent) * run.contributions[i] / (2048.0 * steps);
                sums[static_cast<std::size_t>(run.places[i] * cells)][static_cast<std::size_t>(r)] += value;
            }
            run.chains.renumber_samples();
            sums[cells][static_cast<std::size_t>(r)] = run.chains.mean();
        }
        const double quantile = test::student_quantile(replicates - 1, 0.005 / (4 * (cells + 1)));
        for (std::size_t cell = 0; cell <= cells; cell++) {
            const test::Estimate estimate = test::estimate_from(sums[cell]);
            const double truth =
                cell == cells
                    ? target_mean
                    : target_mean * (target_cdf(static_cast<double>(cell + 1) / cells) - target_cdf(static_cast<double>(cell) / cells));
            EXPECT_NEAR(estimate.mean, truth, quantile * estimate.standard_error) << "large steps " << large_step << ", cell " << cell;
            EXPECT_LT(estimate.standard_error, 0.03 * truth);
        }
    }
}

// Each chain's states, decisions and weights by a plain loop, with the step's length by the paper's formula.
TEST_F(MarkovChainsOnTarget, ChainsAreThoseOfAPlainLoop)
{
    constexpr std::uint64_t seed = 0x123456789abcdef0u;
    constexpr std::size_t chains = 512;
    constexpr uint steps = 40;
    constexpr double large_step = 0.25;
    Run run(device_, target_, settings(chains, steps, large_step, seed));
    run.start(5000);
    const std::array<uint, 2> key{static_cast<uint>(seed), static_cast<uint>(seed >> 32)};
    const std::vector<MarkovChain> starts = run.chains.states().download();
    const Buffer<uint>& coordinates = *run.chains.numbers().chains.coordinates;
    const std::vector<uint> first_words = coordinates.download();
    const double reference = run.chains.mean();
    for (uint step = 0; step < steps; step++) run.step(step);
    const std::vector<SampleWeight> weights = run.chains.weights().download();
    const std::vector<uint> last_words = coordinates.download();
    const std::vector<MarkovChain> states = run.chains.states().download();

    const auto state_of = [](const std::vector<uint>& words, const MarkovChain& chain, std::size_t c) {
        PlainState state;
        state.blocks = chain.blocks[0];
        for (std::size_t block = 0; block < 12; block++)
            for (std::size_t i = 0; i < 4; i++) state.words[block][i] = words[(c * 2 * 12 + block) * 4 + i];
        return state;
    };
    std::uint64_t accepted = 0;
    for (std::size_t c = 0; c < chains; c++) {
        PlainState state = state_of(first_words, starts[c], c);
        std::size_t sample = c;
        std::vector<double> expected(steps + 1, 0.0), independent(steps + 1, 0.0); // weights
        std::size_t current = 0;
        for (uint step = 0; step < steps; step++) {
            const auto decision = plain_philox({static_cast<uint>(c), step, 0, STREAM_DECISION << 28}, key);
            const auto seeds = plain_philox({static_cast<uint>(c), step, 0, STREAM_PROPOSAL << 28}, key);
            const bool large = decision[1] / 4294967296.0 < large_step;
            PlainState proposal;
            constexpr std::array<uint, 4> lanes{0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u};
            for (uint block = 0; block < 12; block++) {
                for (std::size_t i = 0; i < 4; i++) {
                    const uint word = plain_hash(plain_hash((seeds[0] + block * 0x9e3779b9u) ^ lanes[i]) ^ seeds[1]);
                    const double length = 1.0 / 64 * std::exp(-std::log(16.0) * (1 - word / 4294967296.0));
                    const auto moved = static_cast<uint>(static_cast<std::int64_t>(state.words[block][i]) +
                                                         static_cast<std::int64_t>(4294967296.0 * (word % 2 ? -length : length)));
                    proposal.words[block][i] = large || block >= state.blocks ? word : moved;
                }
            }
            proposal.blocks = proposal.is_long() ? 12 : 6;
            const double proposed = proposal.contribution(), now = state.contribution();
            const double acceptance = std::min(1.0, proposed / now);
            expected[step + 1] = acceptance / (proposed / reference + large_step);
            independent[step + 1] = (large ? 1 : 0) / (proposed / reference + large_step);
            expected[current] += (1 - acceptance) / (now / reference + large_step);
            if (decision[0] / 4294967296.0 >= acceptance) continue;
            state = proposal;
            current = step + 1;
            sample = chains * (step + 1) + c;
            accepted++;
        }
        ASSERT_EQ(states[c].sample, sample) << "chain " << c;
        ASSERT_EQ(states[c].blocks[0], state.blocks);
        const PlainState end = state_of(last_words, states[c], c);
        for (std::size_t block = 0; block < state.blocks; block++)
            for (std::size_t i = 0; i < 4; i++) // 40 steps of 1/64 at most, each to 5e-6 of it
                ASSERT_LT(std::abs(static_cast<std::int32_t>(end.words[block][i] - state.words[block][i])) * 0x1p-32, 40 * 5e-6 / 64);
        for (uint step = 0; step <= steps; step++) {
            ASSERT_NEAR(weights[chains * step + c].chain, expected[step], 1e-4 * (1 + expected[step]));
            ASSERT_NEAR(weights[chains * step + c].independent, independent[step], 1e-4 * (1 + independent[step]));
        }
    }
    run.chains.renumber_samples();
    EXPECT_EQ(run.chains.accepted(), accepted);
    EXPECT_EQ(run.chains.proposed(), chains * steps);
    // Both kinds of decision were made often.
    EXPECT_GT(accepted, chains * steps / 4);
    EXPECT_LT(accepted, chains * steps * 9 / 10);
}

TEST_F(MarkovChainsOnTarget, WaitWhereNothingContributes)
{
    MarkovChains chains(device_, settings(64, 1, 0.3, 1));
    const auto nothing = upload(std::vector<float>(64, 0.0f));
    EXPECT_FALSE(chains.start(1000, [&]() -> const Buffer<float>& { return nothing; }));
    EXPECT_FALSE(chains.started());
    const auto one = upload([] {
        std::vector<float> found(64, 0.0f);
        found[10] = 128.0f;
        found[11] = NAN;
        return found;
    }());
    EXPECT_TRUE(chains.start(64, [&]() -> const Buffer<float>& { return one; }));
    EXPECT_TRUE(chains.started());
    EXPECT_EQ(chains.seeds(), 1064u);
    EXPECT_DOUBLE_EQ(chains.mean(), 128.0 / 1064); // samples that found nothing count
}

// The image is what it would be had the last factor been known from the first iteration on; what is not finite stays out.
TEST_F(MarkovChainsOnTarget, IterationsAreCorrectedForFactorsThatWereLearnedLater)
{
    ChainRadiance chain_radiance(device_, 2);
    const float values[4] = {1, 5, 2, 3};
    const double factors[4] = {0.5, 2, 1.5, 1.25};
    float sum = 0; // over iterations of the first pixel's green
    for (int i = 0; i < 4; i++) {
        auto film = upload(std::vector<Vec3>(2, Vec3{0, 0.25f, 0}));
        chain_radiance.radiance.upload(std::vector<Vec3>{{values[i], 2 * values[i], 0}, {i == 1 ? NAN : 1.0f, 0, 0}});
        chain_radiance.add_to(film, factors[i]);
        EXPECT_FLOAT_EQ(film.read(0).y, 0.25f + 2 * values[i] * static_cast<float>(factors[i]));
        sum += film.read(0).y - 0.25f;
    }
    const std::vector<Vec3> correction = chain_radiance.correction(3, 0, chain_radiance.radiance.size());
    EXPECT_FLOAT_EQ(sum + correction[0].y, 2 * 3 * (1 + 5 + 2 + 3));
    EXPECT_FLOAT_EQ(correction[0].x, correction[0].y / 2);
    EXPECT_FLOAT_EQ(correction[1].x, 3 * 3 - (0.5f + 1.5f + 1.25f));
    EXPECT_FLOAT_EQ(chain_radiance.radiance.read(0).x, 0);
}

TEST(ResampledSeeds, AreInProportionToContributions)
{
    const std::vector<float> contributions{1, 0, 3, NAN, 0.5f, INFINITY, 5.5f, 0};
    for (double u : {0.0, 0.3, 0.999}) {
        std::vector<int> counts(contributions.size(), 0);
        for (uint seed : resample_seeds(contributions, 1000, u)) counts.at(seed)++;
        for (std::size_t i = 0; i < counts.size(); i++) {
            const double share = std::isfinite(contributions[i]) ? 100.0 * double(contributions[i]) : 0.0;
            EXPECT_NEAR(counts[i], share, share > 0 ? 1.0 : 0.0) << "seed " << i << ", u " << u;
        }
    }
    EXPECT_TRUE(resample_seeds({0, NAN, 0}, 10, 0.5).empty());
    EXPECT_EQ(resample_seeds({0, 2, 0}, 3, 0.99), (std::vector<uint>{1, 1, 1}));
}

} // namespace
} // namespace sundog
