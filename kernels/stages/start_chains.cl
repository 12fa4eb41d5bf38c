// Chains take what they propose as their states, whatever it is. Reads contributions; updates chains and coordinates. One work-item
// a chain. Used by methods that drive paths by Markov chains.
#include "math/chain_numbers.h"

__kernel void start_chains(__global const float* restrict contributions, uint stored_blocks, uint count,
                           __global MarkovChain* restrict chains, __global uint* restrict coordinates)
{
    const uint chain = get_global_id(0);
    if (chain >= count) return;
    take_proposal(make_chain_view(chains, coordinates, stored_blocks), chain, chains, coordinates);
    chains[chain].contribution = contributions[chain];
    chains[chain].sample = chain;
}
