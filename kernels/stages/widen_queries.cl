// Copies queries with radii wide enough for Laplacians: at least `least_radius`, and `ratio` times their own. Reads
// queries; writes wide. One work-item a query. Used where errors are estimated.
#include "shared/photon.h"

__kernel void widen_queries(__global const GatherQuery* restrict queries, uint count, float least_radius, float ratio,
                            __global GatherQuery* restrict wide)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    GatherQuery query = queries[index];
    if (query.radius > 0.0f) query.radius = fmax(least_radius, ratio * query.radius);
    wide[index] = query;
}
