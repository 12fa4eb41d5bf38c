// Markov chains in the space of primary samples, the random numbers that paths are made of [Kelemen et al. 2002, A Simple and
// Robust Mutation Strategy for the Metropolis Light Transport Algorithm]. Nothing here knows what a chain's numbers are used for.
#ifndef SUNDOG_SHARED_MARKOV_CHAIN_H
#define SUNDOG_SHARED_MARKOV_CHAIN_H
#include "shared/platform.h"
SHARED_BEGIN

// A chain's current state and its proposal. Numbers come in blocks of four (shared/sampler.h), from two streams: camera (0) and
// light (1). blocks: how many of each stream are kept, from the first; 0 where none are used.
typedef struct MarkovChain {
    float contribution; // scalar of the current state: what the chain's density is proportional to
    uint sample;        // the current state's place among the iteration's samples
    uint blocks[2];
    uint kind;       // of the proposal
    uint seeds[4];   // of its independent numbers: two words of each stream
    uint proposed_blocks[2];
} MarkovChain;
SHARED_SIZE(MarkovChain, 44);

#define PROPOSAL_SMALL 0u // each number a little moved
#define PROPOSAL_LARGE 1u // all numbers independent
#define PROPOSAL_SEED 2u  // the same, of a sample that a chain may start from

// Of a chain's proposals since the host has looked: sum of the contributions of large steps with its rounding error, their number,
// and how many proposals of any kind were accepted.
typedef struct ChainTally {
    float large_sum;
    float large_error;
    uint large_count;
    uint accepted;
} ChainTally;
SHARED_SIZE(ChainTally, 16);

// How samples are weighted. reference: what contributions are divided by in weights, near their mean b and the same for a whole
// render; large_step: probability of large steps.
typedef struct SampleWeighting {
    float reference;
    float large_step;
} SampleWeighting;
SHARED_SIZE(SampleWeighting, 8);

// Of a sample, in two parts: as a chain's, to be multiplied by b / reference, and as an independent one.
typedef struct SampleWeight {
    float chain;
    float independent;
} SampleWeight;
SHARED_SIZE(SampleWeight, 8);

SHARED_END
#endif
