// Starts light paths. Reads the lights; writes rays, paths (with flux as throughput) and the list of active
// paths. One work-item a path. Used by every method that traces from the lights.
#include "math/sampler.h"
#include "scene/emission.h"
#include "shared/path.h"

__kernel void emit_light_paths(SURFACE_PARAMETERS, SamplerKey key, uint count, __global Ray* restrict rays, __global PathState* restrict paths,
                               __global uint* restrict active)
{
    const uint path = get_global_id(0);
    if (path >= count) return;

    const SurfaceView scene = SURFACE_VIEW;
    Sampler sampler = light_sampler(key, path, count, 0u);
    const uint4 words = next_words(&sampler);
    const float4 u_direction = next_4d(&sampler);
    const EmissionSample emission = sample_emission(&scene, words, u_direction.xy);
    rays[path] = emission.ray;
    PathState state = {pack(emission.flux), PDF_DELTA, 1u, 0u, 1.0f, emission.path_flags};
    paths[path] = state;
    active[path] = path;
}
