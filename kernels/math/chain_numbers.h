// The numbers that a Markov chain proposes, as a function of its state: nothing is written until a proposal is accepted.
#ifndef SUNDOG_CHAIN_NUMBERS_H
#define SUNDOG_CHAIN_NUMBERS_H
#include "math/hash.h"
#include "math/philox.h"
#include "shared/markov_chain.h"
#include "shared/sampler.h"

// All chains, as kernels that draw their numbers see them. coordinates: of the current states, [chain][stream][block] of four words.
typedef struct ChainView {
    __global const MarkovChain* chains;
    __global const uint* coordinates;
    uint stored_blocks; // kept of each stream
} ChainView;

static inline ChainView make_chain_view(__global const MarkovChain* chains, __global const uint* coordinates, uint stored_blocks)
{
    const ChainView view = {chains, coordinates, stored_blocks};
    return view;
}

// 2^f - 1 for a fraction f, both in units of 2^-32, to 5e-6. In integers, for a coordinate must be the same to the last bit in
// every program that asks for it.
static inline uint4 exp2_fraction(uint4 f)
{
    uint4 p = (uint4)(58849608u);            // 0.0137020
    p = mul_hi(p, f) + (uint4)(222239925u);  // 0.0517443
    p = mul_hi(p, f) + (uint4)(1037448586u); // 0.2415498
    p = mul_hi(p, f) + (uint4)(2976429175u); // 0.6930039
    return mul_hi(p, f);
}

// Each coordinate moved up or down by 2^-10 to 2^-6, log-uniformly: by s2 exp(-ln(s2 / s1) xi), s1 = 1/1024, s2 = 1/64
// [Kelemen et al. 2002, section 3.2]. Words are fractions of 2^32, and wrap around as the paper has them do.
static inline uint4 small_step(uint4 coordinates, uint4 random)
{
    const uint4 octave = random >> 30;
    const uint4 distance = ((uint4)(1u << 22) << octave) + (exp2_fraction(random << 2) >> ((uint4)(10u) - octave));
    return select(coordinates + distance, coordinates - distance, random << 31); // by the lowest bit
}

// One stream of one chain's proposal.
typedef struct ChainStream {
    __global const uint* coordinates; // of the current state
    uint2 seed;
    uint kept; // blocks that are moved from where they are
} ChainStream;

static inline size_t first_coordinate(uint chain, uint stream, uint stored_blocks) { return ((size_t)chain * 2u + stream) * stored_blocks * 4u; }

// stream: 0 or 1, as in MarkovChain.
static inline ChainStream chain_stream(ChainView view, uint chain, uint stream)
{
    __global const MarkovChain* state = view.chains + chain;
    ChainStream result;
    result.coordinates = view.coordinates + first_coordinate(chain, stream, view.stored_blocks);
    result.seed = vload2(stream, state->seeds);
    result.kept = state->kind == PROPOSAL_SMALL ? state->blocks[stream] : 0u;
    return result;
}

// Block `block` of the numbers that 64 bits of seed stand for: two rounds of hashing, for a fifth of what Philox takes.
static inline uint4 seeded_words(uint2 seed, uint block)
{
    const uint4 lanes = (seed.x + block * 0x9e3779b9u) ^ (uint4)(0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u);
    return hash_uint4(hash_uint4(lanes) ^ seed.y);
}

// Numbers that the current state does not use have no bearing on its contribution: given those it uses they are uniform, and are
// drawn anew for each proposal (a Gibbs step) instead of being kept and moved. Where a proposal is longer than its state its
// further numbers are independent, then, and so are those beyond what is stored.
static inline uint4 proposed_words(const ChainStream* stream, uint block)
{
    const uint4 independent = seeded_words(stream->seed, block);
    return block < stream->kept ? small_step(vload4(block, stream->coordinates), independent) : independent;
}

// The proposal's numbers become the chain's, as far as it uses them.
static inline void take_proposal(ChainView view, uint chain, __global MarkovChain* chains, __global uint* coordinates)
{
    for (uint i = 0u; i < 2u; ++i) {
        const ChainStream stream = chain_stream(view, chain, i);
        const uint blocks = chains[chain].proposed_blocks[i];
        __global uint* target = coordinates + first_coordinate(chain, i, view.stored_blocks);
        for (uint block = 0u; block < blocks; ++block) vstore4(proposed_words(&stream, block), block, target);
        chains[chain].blocks[i] = blocks;
    }
}

// Begins a proposal: its kind, and with it where its independent numbers come from.
static inline void propose(__global MarkovChain* chain, uint kind, uint4 seeds)
{
    chain->kind = kind;
    vstore4(seeds, 0, chain->seeds);
    chain->proposed_blocks[0] = chain->proposed_blocks[1] = 0u;
}

// Of a step of a chain. purpose: for which of its decisions.
static inline uint4 step_words(SamplerKey key, uint chain, uint purpose)
{
    return philox4x32((uint4)(chain, key.iteration_low, key.iteration_high, purpose << 28), (uint2)(key.seed_low, key.seed_high));
}

#endif
