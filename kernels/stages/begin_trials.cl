// Starts the trials of pairs that bring light. Reads pairs, what they bring and whether that is free, vertices and paths; writes states
// and which pairs take part. One work-item a pair. Used by upg.
#include "scene/trial_cone.h"
#include "shared/trials.h"

__kernel void begin_trials(float radius, uint count, __global const VertexPair* restrict pairs,
                           __global const PathVertex* restrict camera_vertices, __global const PathVertex* restrict light_vertices,
                           __global const PathState* restrict paths, __global const uint* restrict occluded, __global const Vec3* restrict radiance,
                           __global TrialState* restrict states, __global uint* restrict flags)
{
    const uint item = get_global_id(0);
    if (item >= count) return;
    TrialState state = {0u, 0.0f, 1.0f, 0.0f};
    const bool takes_part = !occluded[item] && !is_black(unpack(radiance[item]));
    if (takes_part) {
        Surface surface;
        const Scattering scattering = scattering_of(camera_vertices + pairs[item].path, &surface);
        const TrialCone cone = bounding_cone(&surface, unpack(light_vertices[pairs[item].slot].position), radius);
        state.bound = density_bound(&surface, &scattering, &cone, paths[pairs[item].path].pdf_w);
    }
    states[item] = state;
    flags[item] = takes_part ? PATH_ALIVE : PATH_ENDED;
}
