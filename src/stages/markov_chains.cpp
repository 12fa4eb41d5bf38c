#include "stages/markov_chains.h"

#include "device/buffer_state.h"

#include "math/mix_bits.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace sundog
{

std::vector<uint> resample_seeds(const std::vector<float>& contributions, std::size_t chains, double u)
{
    const auto valid = [](float x) { return std::isfinite(x) ? static_cast<double>(x) : 0.0; };
    const double total =
        std::accumulate(contributions.begin(), contributions.end(), 0.0, [&](double sum, float x) { return sum + valid(x); });
    if (!(total > 0.0)) return {};
    std::vector<uint> seeds;
    double sum = 0.0;
    uint last = 0; // with a contribution, for rounding at the end
    for (std::size_t i = 0; i < contributions.size(); i++) {
        if (!(valid(contributions[i]) > 0.0)) continue;
        sum += valid(contributions[i]);
        last = static_cast<uint>(i);
        while (seeds.size() < chains && (static_cast<double>(seeds.size()) + u) * total < sum * static_cast<double>(chains))
            seeds.push_back(last);
    }
    seeds.resize(chains, last);
    return seeds;
}

MarkovChains::MarkovChains(Device& device, const MarkovChainSettings& settings)
    : settings_(settings), stored_blocks_(settings.vertices * BLOCKS_PER_VERTEX), key_(sampler_key(settings.seed, 0)),
      propose_mutations_(device, "propose_mutations", "Propose mutations"), propose_seeds_(device, "propose_seeds", "Propose seeds"),
      count_used_numbers_(device, "count_used_numbers", "Count used numbers"), start_chains_(device, "start_chains", "Start chains"),
      accept_mutations_(device, "accept_mutations", "Accept mutations"), renumber_samples_(device, "renumber_samples", "Renumber samples"),
      chains_(device, std::vector<MarkovChain>(settings.chains), "Markov chains"),
      coordinates_(device, std::vector<uint>(settings.chains * 2 * stored_blocks_ * 4), "chain coordinates"),
      seed_numbers_(device, settings.chains, "seed numbers"),
      weights_(device, settings.chains * (1 + std::size_t(settings.steps)), "sample weights"),
      tallies_(device, std::vector<ChainTally>(settings.chains), "chain tallies")
{
    weights_.fill({0.0f, 0.0f});
}

void MarkovChains::propose_seeds(std::vector<uint> numbers)
{
    const uint count = static_cast<uint>(settings_.chains);
    numbers.resize(count, numbers.back());
    seed_numbers_.upload(numbers);
    key_ = sampler_key(settings_.seed, 0);
    propose_seeds_(count, key_, seed_numbers_, count, chains_);
}

bool MarkovChains::start(std::size_t seeds, const std::function<const Buffer<float>&()>& evaluate)
{
    std::vector<float> contributions;
    const uint first = static_cast<uint>(seeds_);
    while (contributions.size() < seeds) {
        const std::size_t batch = std::min(settings_.chains, seeds - contributions.size());
        std::vector<uint> numbers(batch);
        std::iota(numbers.begin(), numbers.end(), first + static_cast<uint>(contributions.size()));
        propose_seeds(numbers);
        const std::vector<float> found = evaluate().download(0, batch);
        contributions.insert(contributions.end(), found.begin(), found.end());
    }
    for (float x : contributions)
        if (std::isfinite(x)) independent_sum_ += static_cast<double>(x);
    independent_count_ += seeds;
    seeds_ += seeds;
    const double u = static_cast<double>(mix_bits(mix_bits(settings_.seed ^ 0x9e3779b97f4a7c15u) + first) >> 11) * 0x1p-53;
    std::vector<uint> starts = resample_seeds(contributions, settings_.chains, u);
    if (starts.empty()) return false;
    for (uint& start : starts) start += first;
    propose_seeds(std::move(starts));
    start_chains_(settings_.chains, evaluate(), stored_blocks_, static_cast<uint>(settings_.chains), chains_, coordinates_);
    reference_ = mean();
    return true;
}

void MarkovChains::forget()
{
    reference_ = independent_sum_ = 0.0;
    independent_count_ = 0;
    weights_.upload(std::vector<SampleWeight>(weights_.size()));
}

SampleWeighting MarkovChains::weighting() const
{
    return {static_cast<float>(reference_), static_cast<float>(settings_.large_step)};
}

void MarkovChains::propose(std::uint64_t step)
{
    assert(steps_ < settings_.steps);
    key_ = sampler_key(settings_.seed, step);
    propose_mutations_(settings_.chains, key_, static_cast<float>(settings_.large_step), static_cast<uint>(settings_.chains), chains_);
}

void MarkovChains::count_used_numbers(ChainStream stream, const Buffer<PathState>& paths)
{
    count_used_numbers_(settings_.chains, paths, static_cast<uint>(stream), stored_blocks_, static_cast<uint>(settings_.chains), chains_);
}

void MarkovChains::accept(const Buffer<float>& contributions)
{
    accept_mutations_(settings_.chains, key_, weighting(), contributions, next_sample(), stored_blocks_,
                      static_cast<uint>(settings_.chains), chains_, coordinates_, weights_, tallies_);
    steps_++;
    proposed_ += settings_.chains;
}

void MarkovChains::renumber_samples()
{
    renumber_samples_(settings_.chains, static_cast<uint>(settings_.chains), chains_, weights_);
    steps_ = 0;
    for (const ChainTally& tally : tallies_.download()) {
        independent_sum_ += static_cast<double>(tally.large_sum) + static_cast<double>(tally.large_error);
        independent_count_ += tally.large_count;
        accepted_ += tally.accepted;
    }
    tallies_.upload(std::vector<ChainTally>(settings_.chains));
}

void MarkovChains::serialize(StateArchive& archive)
{
    archive.value("chain reference", reference_);
    archive.value("independent sum", independent_sum_);
    archive.count("independent count", independent_count_);
    archive.count("seeds", seeds_);
    archive.count("proposed mutations", proposed_);
    archive.count("accepted mutations", accepted_);
    constexpr double largest_scale = 1e10; // it is near 1
    const auto is_mean = [](double b) { return b >= std::numeric_limits<float>::min() && b <= std::numeric_limits<float>::max(); };
    archive.check(reference_ == 0.0 || (is_mean(reference_) && independent_count_ > 0 && is_mean(mean()) && scale() <= largest_scale),
                  "chain reference");
    archive.check(independent_sum_ >= 0.0 && std::isfinite(independent_sum_), "independent sum");
    archive.check(accepted_ <= proposed_, "accepted mutations");
    sundog::serialize(archive, "Markov chains", chains_, [this](const MarkovChain& chain) {
        const auto is_stored = [this](const uint* blocks) { return blocks[0] <= stored_blocks_ && blocks[1] <= stored_blocks_; };
        return chain.contribution >= 0.0f && std::isfinite(chain.contribution) && chain.sample < settings_.chains && is_stored(chain.blocks) &&
               is_stored(chain.proposed_blocks) && chain.kind <= PROPOSAL_SEED;
    });
    sundog::serialize(archive, "chain coordinates", coordinates_);
}

} // namespace sundog
