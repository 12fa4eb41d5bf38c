// Decides what kind of step each chain proposes next: a large one, of independent numbers, with the given probability, or a small
// one [Kelemen et al. 2002, section 3.2]. key: its iteration numbers the chains' steps. Updates chains. One work-item a chain. Used
// by methods that drive paths by Markov chains.
#include "math/chain_numbers.h"

__kernel void propose_mutations(SamplerKey key, float large_step, uint count, __global MarkovChain* restrict chains)
{
    const uint chain = get_global_id(0);
    if (chain >= count) return;
    const float u = unit_float(step_words(key, chain, STREAM_DECISION).y);
    propose(&chains[chain], u < large_step ? PROPOSAL_LARGE : PROPOSAL_SMALL, step_words(key, chain, STREAM_PROPOSAL));
}
