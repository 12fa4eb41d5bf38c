// Asks for light at photons, on their side: queries whose answer is the irradiance there. Reads `count` photons from `first` on;
// writes queries, without radius beyond the photons' end. One work-item a query. Used by photonmapper.
#include "density/photon_depth.h"
#include "shared/path.h"
#include "shared/photon.h"

__kernel void query_photons(__global const Photon* restrict photons, uint first, uint photon_count, float radius, uint count,
                            __global GatherQuery* restrict queries)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    GatherQuery query = {{0.0f, 0.0f, 0.0f}, 0.0f, {1.0f, 1.0f, 1.0f}, UNBOUNDED_DEPTH, {0.0f, 0.0f, 1.0f}, 0u};
    if (first + index < photon_count) {
        const Photon photon = photons[first + index];
        query.position = photon.position;
        query.normal = pack(photon_normal(photon.normal_depth));
        query.radius = radius;
    }
    queries[index] = query;
}
