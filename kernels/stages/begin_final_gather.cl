// Sends gather rays out [Jensen 1996, section 4.2]: a camera path that asked for photons goes on by the same lobe. Reads
// queries, hits and paths as shade_query_path left them; writes the next ray, the list of all paths, and which of them go on.
// One work-item a camera path. Used by photonmapper.
#include "scene/continue_path.h"
#include "shared/photon.h"

__kernel void begin_final_gather(SURFACE_PARAMETERS, SamplerKey key, PathRules rules, uint count,
                                 __global const GatherQuery* restrict queries, __global const Hit* restrict hits, __global Ray* restrict rays,
                                 __global PathState* restrict paths, __global uint* restrict active, __global uint* restrict flags)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    active[index] = index;
    flags[index] = PATH_ENDED;
    // At narrow lobes a path either asked or went on.
    if (queries[index].radius == 0.0f || (queries[index].flags & QUERY_UNREACHED_ONLY)) return;
    PathState path = paths[index];
    // The gather ray is one edge, the photon's path another.
    if (path.depth + 2u > rules.max_depth) return;
    const SurfaceView scene = SURFACE_VIEW;
    const Surface surface = surface_at(&scene, rays[index], hits[index]);
    Sampler sampler = camera_sampler(key, index, path.depth);
    const Scattering scattering = scattering_at(&scene, &surface, unit_float(next_words(&sampler).w));
    Ray next;
    if (!continue_camera_path(&surface, &scattering, rules, &sampler, &path, &next)) return;
    rays[index] = next;
    paths[index] = path;
    flags[index] = PATH_ALIVE;
}
