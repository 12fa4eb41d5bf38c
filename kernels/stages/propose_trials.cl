// Rays of the next trials. Reads the pairs still waiting (`waiting` of them), their states and vertices; writes `per_pair` rays for each
// and for each its chance to count if it meets the ball: the density of the path's own directions over the bound. One work-item a ray.
// Used by upg.
#include "math/philox.h"
#include "scene/trial_cone.h"
#include "shared/trials.h"

// Each trial of a pair has numbers of its own, whatever trials are made side by side.
static inline uint4 trial_words(SamplerKey key, VertexPair pair, uint depth, uint trial)
{
    const uint2 pass = (uint2)(hash_combine(key.seed_low, key.iteration_low), hash_combine(key.seed_high, key.iteration_high));
    return philox4x32((uint4)(trial, pair.slot, pair.path, (STREAM_TRIAL << 28) | depth), pass);
}

__kernel void propose_trials(SamplerKey key, PathRules rules, float radius, uint waiting, uint per_pair,
                             __global const uint* restrict waiting_pairs, __global const VertexPair* restrict pairs,
                             __global const PathVertex* restrict camera_vertices, __global const PathVertex* restrict light_vertices,
                             __global const TrialState* restrict states, __global Ray* restrict rays, __global Trial* restrict trials)
{
    const uint item = get_global_id(0);
    if (item >= waiting * per_pair) return;
    const uint index = waiting_pairs[item / per_pair];
    const VertexPair pair = pairs[index];
    const TrialState state = states[index];
    __global const PathVertex* vertex = camera_vertices + pair.path;
    Surface surface;
    const Scattering scattering = scattering_of(vertex, &surface);
    PathState path = path_at(vertex);
    const float4 u = unit_float4(trial_words(key, pair, path.depth, state.count + item % per_pair));
    Ray ray = no_ray();
    Trial trial = {0.0f, u.z};
    if (state.bound > 0.0f) {
        const TrialCone cone = bounding_cone(&surface, unpack(light_vertices[pair.slot].position), radius);
        const float3 direction = to_world(cone.frame, sample_cone(u.xy, cone.one_minus_cos));
        trial.chance = continuation_pdf_w(&surface, &scattering, rules, &path, direction) / state.bound;
        if (trial.chance > 0.0f) ray = ray_from(&surface, direction);
    } else if (extend_camera_path(&surface, &scattering, rules, u, &path, &ray)) {
        trial.chance = 1.0f;
    }
    if (!(trial.chance > 0.0f)) ray = no_ray();
    rays[item] = ray;
    trials[item] = trial;
}
