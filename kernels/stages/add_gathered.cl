// Adds gathered photons to radiance: throughput * sum / emitted paths. Reads queries and sums; updates
// radiance. One work-item a query. Used by pppm and appm.
#include "math/vec3.h"
#include "shared/photon.h"

__kernel void add_gathered(__global const GatherQuery* restrict queries, __global const GatherSum* restrict sums, uint count, float inverse_paths,
                           __global Vec3* restrict radiance)
{
    const uint index = get_global_id(0);
    if (index >= count || queries[index].radius == 0.0f) return;
    radiance[index] = pack(unpack(radiance[index]) + unpack(queries[index].throughput) * unpack(sums[index].flux) * inverse_paths);
}
