// Counts trials until one succeeds: their number has the mean 1 / P, however they are dealt out. It is one case of
//     1 / P = 1 / c + (1 - P / c) 1 / P
// unrolled, with an unbiased estimate p of P in each factor 1 - p / c, as a probability to go on [Booth 2007, Unbiased Monte Carlo
// Estimation of the Reciprocal of an Integral]. It holds for any c that earlier trials have led to: where a density exceeded its
// bound, that trial's factor is negative and weighs the rest, and the bound is raised. Reads
// the trials, their rays and hits; updates states; writes which pairs wait for more. One work-item a waiting pair. Used by upg.
#include "density/near_photons.h"
#include "shared/trials.h"

__kernel void judge_trials(float radius, uint waiting, uint per_pair, __global const uint* restrict waiting_pairs,
                           __global const VertexPair* restrict pairs, __global const PathVertex* restrict light_vertices,
                           __global const Ray* restrict rays, __global const Hit* restrict hits, __global const Trial* restrict trials,
                           __global TrialState* restrict states, __global uint* restrict flags)
{
    const uint item = get_global_id(0);
    if (item >= waiting) return;
    const uint index = waiting_pairs[item];
    const float3 center = unpack(light_vertices[pairs[index].slot].position);
    TrialState state = states[index];
    uint flag = PATH_ALIVE;
    for (uint i = item * per_pair; i < (item + 1u) * per_pair; ++i) {
        const Trial trial = trials[i];
        state.sum += state.bound > 0.0f ? state.weight / state.bound : state.weight;
        ++state.count;
        const bool meets = trial.chance > 0.0f && hits[i].primitive != NO_PRIMITIVE && in_ball(hit_position(rays[i], hits[i].t) - center, radius);
        const float factor = 1.0f - (meets ? trial.chance : 0.0f);
        const float survival = fmin(fabs(factor), 1.0f);
        if (!(trial.u < survival)) {
            flag = PATH_ENDED;
            break;
        }
        state.weight *= factor / survival;
        if (factor < 0.0f) { // the trials after this one were made for the bound as it was
            state.bound *= 2.0f * trial.chance;
            break;
        }
    }
    states[index] = state;
    flags[item] = flag;
}
