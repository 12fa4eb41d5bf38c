// One interface to the random numbers of a path: four at a time, by dimension.
#ifndef SUNDOG_SAMPLER_H
#define SUNDOG_SAMPLER_H
#include "math/hash.h"
#include "shared/sampler.h"
#if SAMPLER == SAMPLER_CHAIN
#include "math/chain_numbers.h"
#elif SAMPLER == SAMPLER_SOBOL
#include "math/sobol.h"
#else
#include "math/philox.h"
#endif

// What kernels that draw numbers take, and the same as one value for functions: the key, and with Markov chains their states.
#if SAMPLER == SAMPLER_CHAIN
#define SAMPLER_PARAMETERS                                                                                                                 \
    SamplerKey key, __global const MarkovChain* restrict chains, __global const uint* restrict coordinates, uint stored_blocks
#define SAMPLER_VIEW make_chain_view(chains, coordinates, stored_blocks)
typedef ChainView SamplerView;
#else
#define SAMPLER_PARAMETERS SamplerKey key
#define SAMPLER_VIEW key
typedef SamplerKey SamplerView;
#endif

#if SAMPLER == SAMPLER_CHAIN
// Paths are numbered as their chains are.
typedef struct Sampler {
    ChainStream stream;
    uint block; // next block of four dimensions
} Sampler;

static inline Sampler chain_sampler(SamplerView view, uint stream, uint chain, uint depth)
{
    const Sampler sampler = {chain_stream(view, chain, stream), depth * BLOCKS_PER_VERTEX};
    return sampler;
}

static inline Sampler camera_sampler(SamplerView view, uint path, uint depth) { return chain_sampler(view, 0u, path, depth); }

static inline Sampler light_sampler(SamplerView view, uint path, uint paths, uint depth) { return chain_sampler(view, 1u, path, depth); }

static inline uint4 next_words(Sampler* sampler) { return proposed_words(&sampler->stream, sampler->block++); }
#else
typedef struct Sampler {
    uint2 seed;  // independent: the generator's key; Sobol: x is the sequence's seed
    ulong index; // position in the sequence
    uint sequence;
    uint block; // next block of four dimensions; the stream in its top bits
} Sampler;

// A path's sampler, at the start of vertex `depth` (0: the path's origin). `sequence` numbers the
// sequences of a stream (a pixel's, say), `index` the points of the sequence.
static inline Sampler make_sampler(SamplerKey key, uint stream, uint sequence, ulong index, uint depth)
{
    Sampler sampler;
    sampler.index = index;
    sampler.sequence = sequence;
    sampler.block = (stream << 28) | (depth * BLOCKS_PER_VERTEX);
#if SAMPLER == SAMPLER_SOBOL
    // The sequence repeats after 2^32 points: the upper half of the index starts a new scrambling.
    sampler.seed.x = hash_uint(hash_uint(key.seed_low + 0x85ebca6bu * key.seed_high) + 0xc2b2ae35u * (uint)(index >> 32) + sequence);
    sampler.seed.y = 0u;
#else
    sampler.seed = (uint2)(key.seed_low, key.seed_high);
#endif
    return sampler;
}

static inline ulong iteration_of(SamplerKey key) { return ((ulong)key.iteration_high << 32) | key.iteration_low; }

// Camera paths: one sequence a pixel, one point an iteration.
static inline Sampler camera_sampler(SamplerKey key, uint path, uint depth)
{
    return make_sampler(key, STREAM_CAMERA, path, iteration_of(key), depth);
}

// Light paths: one sequence for all, continued from iteration to iteration.
static inline Sampler light_sampler(SamplerKey key, uint path, uint paths_per_iteration, uint depth)
{
    return make_sampler(key, STREAM_LIGHT, 0u, iteration_of(key) * paths_per_iteration + path, depth);
}

// The next four numbers, as fractions of 2^32.
static inline uint4 next_words(Sampler* sampler)
{
    const uint block = sampler->block++;
#if SAMPLER == SAMPLER_SOBOL
    return sobol_owen_words((uint)sampler->index, hash_combine(sampler->seed.x, block));
#else
    const uint4 counter = (uint4)((uint)sampler->index, (uint)(sampler->index >> 32), sampler->sequence, block);
    return philox4x32(counter, sampler->seed);
#endif
}
#endif

// The numbers of block `block` of a camera path's vertex alone.
static inline uint4 camera_words(SamplerView numbers, uint path, uint depth, uint block)
{
    Sampler sampler = camera_sampler(numbers, path, depth);
    sampler.block += block;
    return next_words(&sampler);
}

// The same as next_words, each in [0, 1).
static inline float4 next_4d(Sampler* sampler) { return unit_float4(next_words(sampler)); }

#endif
