// Leaves an importon where a camera path asks for photons [Peter and Pietrek 1998]: what photons are to queries. Reads queries;
// writes a record for each, and flags those that ask. One work-item a query. Used by photonmapper.
#include "math/frame.h"
#include "shared/path.h"
#include "shared/photon.h"

__kernel void leave_importons(__global const GatherQuery* restrict queries, uint count, __global Photon* restrict deposits, __global uint* restrict flags)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const GatherQuery query = queries[index];
    const Photon importon = {query.position, 0u, {1.0f, 1.0f, 1.0f}, pack_normal(unpack(query.normal))};
    const bool asks = query.radius > 0.0f;
    if (asks) deposits[index] = importon;
    flags[index] = asks ? PATH_DEPOSIT : PATH_ENDED;
}
