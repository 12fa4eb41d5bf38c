// The photons near a point, eight at a time: the one loop of all stages that look photons up. A stage says what it does with them by
// a visitor, which it defines before it includes this file:
//   VISITOR                      a struct with at least `float3 position`, and what the visit is to find. It goes in and comes
//                                out by value, so that it stays in registers through the loop
//   int8 visitor_reach(const VISITOR*, Offset8 offset, float8* squares)
//                                the lanes within reach, by their offsets from the position, and a measure of their squared
//                                distances. The reach may shrink from one visit to the next
//   VISITOR visit(VISITOR, const PhotonMap*, Photons8)
//                                looks at eight photons, at least one of them within reach
#ifndef SUNDOG_VISIT_PHOTONS_H
#define SUNDOG_VISIT_PHOTONS_H
#include "density/photon_lanes.h"

static inline VISITOR visit_run(VISITOR visitor, const PhotonMap* map, PhotonRun run)
{
    const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
    for (uint i = run.begin; i < run.end; i += 8u) {
        Photons8 photons;
        photons.first = i;
        photons.offset = photon_offsets(map, i, visitor.position);
        photons.mask = visitor_reach(&visitor, photons.offset, &photons.squares) & (lane < (int8)((int)(run.end - i)));
        if (mask8(photons.mask)) visitor = visit(visitor, map, photons);
    }
    return visitor;
}

// Visits all photons within the radius that the grid was built for, and others near them.
static inline VISITOR visit_photons(VISITOR visitor, const PhotonMap* map)
{
    PhotonRun runs[8];
    const uint count = find_photon_runs(&map->grid, map->cell_ends, visitor.position, runs);
    for (uint i = 0u; i < count; ++i) visitor = visit_run(visitor, map, runs[i]);
    return visitor;
}

// The same within any radius. The grid must be dense.
static inline VISITOR visit_photons_within(VISITOR visitor, const PhotonMap* map, float radius)
{
    const CellRange range = cells_within(&map->grid, visitor.position, radius);
    for (uint z = range.z0; z <= range.z1; ++z)
        for (uint y = range.y0; y <= range.y1; ++y) visitor = visit_run(visitor, map, row_run(&map->grid, map->cell_ends, &range, y, z));
    return visitor;
}

#endif
