// How many numbers of a stream (0: camera, 1: light) each chain's proposal has used, in blocks of four. Reads the paths that it
// made, after their last step; updates chains. One work-item a chain. Used by methods that drive paths by Markov chains.
#include "shared/markov_chain.h"
#include "shared/path.h"
#include "shared/sampler.h"

__kernel void count_used_numbers(__global const PathState* restrict paths, uint stream, uint stored_blocks, uint count,
                                 __global MarkovChain* restrict chains)
{
    const uint chain = get_global_id(0);
    if (chain >= count) return;
    chains[chain].proposed_blocks[stream] = min((paths[chain].depth + 1u) * BLOCKS_PER_VERTEX, stored_blocks);
}
