// Starts light subpaths that are to be joined to camera subpaths. Reads the lights; writes rays, paths (with flux as
// throughput), what they carry for their weights, the list of active paths, and that none has a vertex yet. One work-item a
// path. Used by the bidirectional methods.
#include "scene/emission.h"
#include "shared/bidirectional.h"

// [Georgiev 2012, eqs. 31 to 33], but for what depends on where the ray goes: weights_at_vertex and connect_ratio follow.
static inline PathWeights weights_at_light(const EmissionSample* emission, Techniques techniques)
{
    PathWeights weights = {0.0f, 0.0f, 0.0f, 0.0f};
    if (emission->path_flags & PATH_FROM_COLLIMATED_LIGHT) return weights; // neither hit nor chosen by next-event estimation
    weights.vcm = techniques.connect / emission->pdf_ray;
    if (emission->pdf_light > 0.0f) weights.vc = emission->cos_light / (emission->pdf_light * emission->pdf_ray);
    weights.vm = weights.vc * techniques.inverse_merge;
    weights.vc_specular = weights.vc;
    return weights;
}

__kernel void emit_light_subpaths(SURFACE_PARAMETERS, SAMPLER_PARAMETERS, Techniques techniques, uint count, __global Ray* restrict rays,
                                  __global PathState* restrict paths, __global Subpath* restrict subpaths, __global uint* restrict active,
                                  __global uint* restrict last_vertices)
{
    const uint path = get_global_id(0);
    if (path >= count) return;

    const SurfaceView scene = SURFACE_VIEW;
    PathState state;
    const EmissionSample emission = emit_light_path(&scene, SAMPLER_VIEW, path, count, &state);
    rays[path] = emission.ray;
    paths[path] = state;
    const Subpath subpath = {weights_at_light(&emission, techniques), emission.light};
    subpaths[path] = subpath;
    active[path] = path;
    last_vertices[path] = NO_VERTEX;
}
