// Marks the splats of the chains' current states as those to keep, by the sample that each is of. Reads chains and samples; writes
// flags. One work-item a splat. Used by pssmlt.
#include "shared/markov_chain.h"
#include "shared/path.h"

__kernel void flag_current_splats(__global const MarkovChain* restrict chains, uint chain_count, __global const uint* restrict samples, uint count,
                                  __global uint* restrict flags)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    flags[i] = chains[samples[i] % chain_count].sample == samples[i] ? PATH_DEPOSIT : PATH_ENDED;
}
