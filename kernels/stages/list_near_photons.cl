// Last step of listing light vertices near the hits of camera subpaths: each path's last vertex with the vertices near its hit,
// which it is to be connected to in the hit's place [Qin et al. 2015, section 4]. Reads what count_near_photons reads, and each item's
// first place; writes those pairs whose places lie in [window, window + capacity). One work-item an active path. Used by upg.
#include "density/near_photons.h"

// Pairs are numbered from `place` on.
typedef struct Listing {
    float3 position;
    float radius;
    __global const uint* slots;
    __global VertexPair* pairs;
    uint path, place, end, window, capacity;
} Listing;
#define VISITOR Listing

static inline int8 visitor_reach(const Listing* listing, Offset8 offset, float8* squares)
{
    *squares = lengths_in_ball(offset);
    return *squares < listing->radius * listing->radius;
}

static inline Listing visit(Listing listing, const PhotonMap* map, Photons8 photons)
{
    int lanes = lanes_on_vertices(listing.slots, photons);
    for (; lanes != 0 && listing.place < listing.end; lanes &= lanes - 1, ++listing.place) {
        const VertexPair pair = {listing.path, listing.slots[photons.first + (uint)first_lane(lanes)]};
        const uint place = listing.place - listing.window; // unsigned: beyond the capacity also where it is below the window
        if (place < listing.capacity) listing.pairs[place] = pair;
    }
    return listing;
}

#include "density/visit_photons.h"

__kernel void list_near_photons(MAP_PARAMETERS, __global const uint* restrict slots, float radius, __global const uint* restrict active,
                                __global const uint* restrict active_count, __global const Ray* restrict rays,
                                __global const Hit* restrict hits, __global const uint* restrict firsts, uint window, uint capacity,
                                __global VertexPair* restrict pairs)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint first = firsts[item], end = firsts[item + 1u];
    if (first == end || first >= window + capacity || end <= window) return;
    const uint path = active[item];
    const PhotonMap map = MAP_VIEW;
    const Listing none = {hit_position(rays[path], hits[path].t), radius, slots, pairs, path, first, end, window, capacity};
    visit_photons(none, &map);
}
