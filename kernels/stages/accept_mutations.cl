// Metropolis: each chain takes its proposal with the probability of the ratio of contributions. Reads contributions of the
// proposals; writes their weights, at first_sample + chain, and adds to those of the states they were proposed by; updates chains,
// coordinates of those that are taken, and tallies. One work-item a chain. Used by methods that drive paths by Markov chains.
#include "math/chain_numbers.h"
#include "math/compensated.h"

// Of the density 1 that large steps have and the chains' I / b together, by the balance heuristic with reference for b: the sum of
// both parts has the right mean whatever reference is [Kelemen et al. 2002, section 3.3].
static inline float sample_weight(SampleWeighting weighting, float share, float contribution)
{
    return share / (contribution / weighting.reference + weighting.large_step);
}

__kernel void accept_mutations(SamplerKey key, SampleWeighting weighting, __global const float* restrict contributions, uint first_sample,
                               uint stored_blocks, uint count, __global MarkovChain* restrict chains,
                               __global uint* restrict coordinates, __global SampleWeight* restrict weights, __global ChainTally* restrict tallies)
{
    const uint chain = get_global_id(0);
    if (chain >= count) return;
    const float current = chains[chain].contribution, proposed = contributions[chain];
    const uint sample = first_sample + chain;
    const bool large = chains[chain].kind == PROPOSAL_LARGE;
    const bool valid = isfinite(proposed);
    const float acceptance = !valid || !(proposed > 0.0f) ? 0.0f : proposed < current ? proposed / current : 1.0f;

    // Each proposal counts for both, by what is expected of it. One that is not finite shows up in the image's count of those.
    weights[sample].chain = valid ? sample_weight(weighting, acceptance, proposed) : 0.0f;
    weights[sample].independent = !valid ? 1.0f : large ? sample_weight(weighting, 1.0f, proposed) : 0.0f;
    weights[chains[chain].sample].chain += sample_weight(weighting, 1.0f - acceptance, current);

    ChainTally tally = tallies[chain];
    if (large) {
        if (valid) add_compensated(&tally.large_sum, &tally.large_error, proposed);
        tally.large_count += 1u;
    }
    if (unit_float(step_words(key, chain, STREAM_DECISION).x) < acceptance) {
        tally.accepted += 1u;
        take_proposal(make_chain_view(chains, coordinates, stored_blocks), chain, chains, coordinates);
        chains[chain].contribution = proposed;
        chains[chain].sample = sample;
    }
    tallies[chain] = tally;
}
