// One vertex of a light path: leaves a photon on every surface where a query may want it and scatters on. Reads
// hits of the active paths; writes the photon (item by item, to be appended to the map), the next ray,
// and flags. Photons straight from a light are left out where next-event estimation counts them
// (-D DIRECT_LIGHT=1), and so are those that -D PHOTONS_KEPT does not ask for; a path that can leave no more photons ends. One
// work-item an active path. Used by the photon mapping methods.
#include "density/leave_photon.h"

static inline bool scatters_broadly(const Scattering* scattering) { return !is_specular(scattering) && !is_narrow(scattering); }

// Whether a path may leave a photon where it is, and whether it may farther on.
static inline bool keeps_photon(const PathState* path)
{
    return PHOTONS_KEPT == PHOTONS_ALL || (PHOTONS_KEPT == PHOTONS_SCATTERED) == ((path->flags & PATH_SCATTERED_BROADLY) != 0u);
}
static inline bool keeps_more_photons(const Scattering* scattering) { return PHOTONS_KEPT != PHOTONS_CAUSTIC || !scatters_broadly(scattering); }

__kernel void shade_photon_path(SURFACE_PARAMETERS, SAMPLER_PARAMETERS, PathRules rules, uint path_count, __global const Hit* restrict hits,
                                __global const uint* restrict active, __global const uint* restrict active_count, __global Ray* restrict rays,
                                __global PathState* restrict paths, __global Photon* restrict deposits, __global uint* restrict flags)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint index = active[item];
    uint flag = PATH_ENDED;
    const Hit hit = hits[index];
    if (hit.primitive != NO_PRIMITIVE) {
        const SurfaceView scene = SURFACE_VIEW;
        PathState path = paths[index];
        const Surface surface = surface_at(&scene, rays[index], hit);
        Sampler sampler = light_sampler(SAMPLER_VIEW, index, path_count, path.depth);
        Scattering scattering = scattering_at(&scene, &surface, next_4d(&sampler).x);
        disperse(light_hero(&scene, key, index), &path, &scattering);
        const bool counted_elsewhere = DIRECT_LIGHT && path.depth == 1u && !(path.flags & PATH_FROM_COLLIMATED_LIGHT);
        const bool unreached = (path.flags & PATH_FROM_DELTA_LIGHT) && path.scattered == 0u;
        if (wants_photons(&scene, &surface, !unreached) && !counted_elsewhere && keeps_photon(&path)) {
            deposits[item] = make_photon(&surface, &path, unreached);
            flag |= PATH_DEPOSIT;
        }
        // The camera's side of the path has at least one edge: this one's next photon would have one more.
        if ((rules.max_depth == UNBOUNDED_DEPTH || path.depth + 2u <= rules.max_depth) && keeps_more_photons(&scattering)) {
            Ray next;
            if (PHOTONS_KEPT != PHOTONS_ALL && scatters_broadly(&scattering)) path.flags |= PATH_SCATTERED_BROADLY;
            if (continue_light_path(&surface, &scattering, rules, &sampler, &path, &next)) {
                rays[index] = next;
                paths[index] = path;
                flag |= PATH_ALIVE;
            }
        }
    }
    flags[item] = flag;
}
