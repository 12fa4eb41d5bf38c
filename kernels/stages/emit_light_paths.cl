// Starts light paths. Reads the lights; writes rays, paths (with flux as throughput) and the list of active
// paths. One work-item a path. Used by every method that traces from the lights.
#include "scene/emission.h"

__kernel void emit_light_paths(SURFACE_PARAMETERS, SAMPLER_PARAMETERS, uint count, __global Ray* restrict rays, __global PathState* restrict paths,
                               __global uint* restrict active)
{
    const uint path = get_global_id(0);
    if (path >= count) return;

    const SurfaceView scene = SURFACE_VIEW;
    PathState state;
    rays[path] = emit_light_path(&scene, SAMPLER_VIEW, path, count, &state).ray;
    paths[path] = state;
    active[path] = path;
}
