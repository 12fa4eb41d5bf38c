// Many Markov chains side by side, in the space of the random numbers that paths are made of [Kelemen et al. 2002, A Simple and Robust
// Mutation Strategy for the Metropolis Light Transport Algorithm, Computer Graphics Forum 21(3)]. What the numbers are used
// for is for others to say: a chain is told what its proposals contribute, and says what each sample weighs.
#pragma once

#include "base/state_archive.h"
#include "shared/path.h"
#include "stages/sampling.h"

#include <functional>
#include <vector>

namespace sundog
{

struct MarkovChainSettings {
    std::size_t chains = 0;
    uint steps = 1;    // most of each chain between two calls of renumber_samples()
    uint vertices = 1; // of a path, whose numbers are kept: those of later ones are independent in every proposal
    double large_step = 0.3;
    std::uint64_t seed = 0;
};

// Streams of a chain's numbers.
enum class ChainStream : uint { camera = 0, light = 1 };

// Which seeds `chains` chains start from, in proportion to contributions: systematic resampling, with u in [0, 1) for where the
// comb begins. Contributions that are not finite count as 0. Empty when all are 0.
std::vector<uint> resample_seeds(const std::vector<float>& contributions, std::size_t chains, double u);

class MarkovChains
{
public:
    MarkovChains(Device& device, const MarkovChainSettings& settings);

    // Starts the chains from `seeds` independent samples, chosen in proportion to what they contribute. evaluate: makes paths of
    // what is proposed, calls count_used_numbers() for each stream that they use, and returns their contributions by chain.
    // False: none contributed, and the chains wait for another call, with other seeds. before_batch: may throw, which leaves all as
    // it was. Waits.
    bool start(std::size_t seeds, const std::function<const Buffer<float>&()>& evaluate, const std::function<void()>& before_batch = [] {});
    bool started() const { return reference_ > 0.0; }

    // Before another start(), where contributions become others: states and mean() so far mean nothing then.
    void forget();

    // Proposes a step of every chain, numbered from 0 for the whole render.
    void propose(std::uint64_t step);

    // What the proposal's paths draw their numbers from, in kernels built for SamplerKind::chain: path i from chain i.
    SamplerSource numbers() const { return {key_, {&chains_, &coordinates_, stored_blocks_}}; }

    // After the last step of paths that draw from a stream; paths: by chain.
    void count_used_numbers(ChainStream stream, const Buffer<PathState>& paths);

    // Accepts or rejects the proposals.
    void accept(const Buffer<float>& contributions);

    // The chains' samples, numbered: 0 .. chains - 1 the states that renumber_samples() left, and then the proposals of each step in
    // turn, from next_sample() on those that have not been accepted or rejected yet. weights(): so that the sum of
    // (chain * scale() + independent) * value over samples / number of proposals is the mean of the value over all primary samples.
    uint next_sample() const { return static_cast<uint>(settings_.chains) * (1u + steps_); }
    const Buffer<SampleWeight>& weights() const { return weights_; }
    const Buffer<MarkovChain>& states() const { return chains_; }

    // All samples so far have been used; the current states are the first of those to come. mean() learns from the large steps. Waits.
    void renumber_samples();

    // Mean contribution of independent samples: the seeds and all large steps (b in the paper).
    double mean() const { return independent_sum_ / static_cast<double>(independent_count_); }
    double scale() const { return mean() / reference_; } // where started()
    std::size_t count() const { return settings_.chains; }
    std::uint64_t seeds() const { return seeds_; }
    std::uint64_t proposed() const { return proposed_; }
    std::uint64_t accepted() const { return accepted_; }

    void serialize(StateArchive& archive);

private:
    SampleWeighting weighting() const;
    void propose_seeds(std::vector<uint> numbers);

    MarkovChainSettings settings_;
    uint stored_blocks_;
    SamplerKey key_; // of the step under way
    uint steps_ = 0; // since renumber_samples()
    Kernel propose_mutations_, propose_seeds_, count_used_numbers_, start_chains_, accept_mutations_, renumber_samples_;
    Buffer<MarkovChain> chains_;
    Buffer<uint> coordinates_;
    Buffer<uint> seed_numbers_;
    Buffer<SampleWeight> weights_;
    Buffer<ChainTally> tallies_;
    double reference_ = 0.0; // mean() when the chains started
    double independent_sum_ = 0.0;
    std::uint64_t independent_count_ = 0, seeds_ = 0, proposed_ = 0, accepted_ = 0;
};

} // namespace sundog
