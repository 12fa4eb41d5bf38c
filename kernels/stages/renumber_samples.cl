// An iteration's samples have been used: the chains' states are the first of the next ones, with no weight yet. Updates chains;
// writes weights. One work-item a chain. Used by methods that drive paths by Markov chains.
#include "shared/markov_chain.h"

__kernel void renumber_samples(uint count, __global MarkovChain* restrict chains, __global SampleWeight* restrict weights)
{
    const uint chain = get_global_id(0);
    if (chain >= count) return;
    chains[chain].sample = chain;
    const SampleWeight none = {0.0f, 0.0f};
    weights[chain] = none;
}
