// Which light subpath a camera subpath connects to.
#ifndef SUNDOG_SCENE_OWN_LIGHT_PATH_H
#define SUNDOG_SCENE_OWN_LIGHT_PATH_H
#include "math/hash.h"
#include "shared/bidirectional.h"
#include "shared/sampler.h"

// Another one for a pixel in every iteration: light subpaths are numbered by a low-discrepancy sequence, of which every
// count-th point has nearly the same first coordinate. Neighbours have neighbouring ones, so that memory is read in order.
static inline uint own_light_path(SamplerKey key, uint path, uint light_paths)
{
#if SAMPLER == SAMPLER_CHAIN
    return path; // both are made by the numbers of one chain
#else
    const uint iteration = hash_combine(hash_combine(STREAM_LIGHT, key.iteration_low), key.iteration_high);
    const uint shift = hash_combine(hash_combine(iteration, key.seed_low), key.seed_high);
    return (uint)(((ulong)path + shift) % light_paths);
#endif
}

#endif
