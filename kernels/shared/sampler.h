// Where a path's random numbers come from.
#ifndef SUNDOG_SHARED_SAMPLER_H
#define SUNDOG_SHARED_SAMPLER_H
#include "shared/platform.h"
SHARED_BEGIN

// The same for all paths of one pass. Every random number is a pure function of this key, the
// path's stream, sequence and index, and the dimension.
typedef struct SamplerKey {
    uint seed_low;
    uint seed_high;
    uint iteration_low;
    uint iteration_high;
} SamplerKey;
SHARED_SIZE(SamplerKey, 16);

// Streams never share numbers.
#define STREAM_CAMERA 1u
#define STREAM_LIGHT 2u
#define STREAM_THINNING 3u // of photons
// Of Markov chains: what their steps are made of, whether they are taken, and the samples that they start from.
#define STREAM_PROPOSAL 4u
#define STREAM_DECISION 5u
#define STREAM_SEED 6u
#define STREAM_TRIAL 7u // of unbiased gathering

// Structure of the program: -D SAMPLER=...
#define SAMPLER_INDEPENDENT 0
#define SAMPLER_SOBOL 1
#define SAMPLER_CHAIN 2 // proposals of Markov chains (shared/markov_chain.h)

// Blocks of four dimensions that one vertex of a path may use. Block 0 is the path's start.
#define BLOCKS_PER_VERTEX 3u
// Of a camera path's vertex: light sampling and the choice of a lobe, the next direction, and one that few vertices need.
#define BLOCK_SPARE 2u

SHARED_END
#endif
