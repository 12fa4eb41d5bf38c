// Has each chain propose an independent sample of the given number, from which chains may start. Reads numbers; updates chains. One
// work-item a chain. Used by methods that drive paths by Markov chains.
#include "math/chain_numbers.h"

__kernel void propose_seeds(SamplerKey key, __global const uint* restrict numbers, uint count, __global MarkovChain* restrict chains)
{
    const uint chain = get_global_id(0);
    if (chain >= count) return;
    propose(&chains[chain], PROPOSAL_SEED, step_words(key, numbers[chain], STREAM_SEED));
}
