// Gives all queries one radius. Updates queries. One work-item a query. Used by photonmapper.
#include "shared/photon.h"

__kernel void set_query_radius(float radius, uint count, __global GatherQuery* restrict queries)
{
    const uint index = get_global_id(0);
    if (index < count && queries[index].radius > 0.0f) queries[index].radius = radius;
}
