// First step of listing light vertices near the hits of camera subpaths: how many there are. Reads the active paths, their rays and
// hits, the photon map and the slots in its order; writes one count an item. One work-item an active path. Used by upg.
#include "density/near_photons.h"

typedef struct Count {
    float3 position;
    float radius;
    __global const uint* slots;
    uint vertices;
} Count;
#define VISITOR Count

static inline int8 visitor_reach(const Count* count, Offset8 offset, float8* squares)
{
    *squares = lengths_in_ball(offset);
    return *squares < count->radius * count->radius;
}

static inline Count visit(Count count, const PhotonMap* map, Photons8 photons)
{
    count.vertices += popcount((uint)lanes_on_vertices(count.slots, photons));
    return count;
}

#include "density/visit_photons.h"

__kernel void count_near_photons(MAP_PARAMETERS, __global const uint* restrict slots, float radius, __global const uint* restrict active,
                                 __global const uint* restrict active_count, __global const PathState* restrict paths,
                                 __global const Ray* restrict rays, __global const Hit* restrict hits, __global uint* restrict counts)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint path = active[item];
    const PathState state = paths[path];
    const Hit hit = hits[path];
    uint vertices = 0u;
    if (stands_in(&state, &hit)) {
        const PhotonMap map = MAP_VIEW;
        const Count none = {hit_position(rays[path], hit.t), radius, slots, 0u};
        vertices = visit_photons(none, &map).vertices;
    }
    counts[item] = vertices;
}
