// Adds the bias of density estimates with the radii that the queries have, mu_2 / 2 r^2 Delta L [Hachisuka, Jarosz and
// Jensen 2010]. Reads queries and Laplacians (-D LAPLACIAN_SUM: of which type); updates bias (W/m^2/sr).
// half_moment: mu_2 / 2 over emitted paths. One work-item a query. Used where errors are estimated.
#include "math/vec3.h"
#include "shared/adaptive_radius.h"
#include "shared/error_estimate.h"
#include "shared/photon.h"

__kernel void add_bias(__global const GatherQuery* restrict queries, __global const LAPLACIAN_SUM* restrict laplacians, uint count,
                       float half_moment, __global Vec3* restrict bias)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const float radius = queries[index].radius;
    if (radius == 0.0f) return;
    const float3 laplacian = unpack(queries[index].throughput) * unpack(laplacians[index].laplacian);
    const float3 added = laplacian * (half_moment * radius * radius);
    if (is_finite3(added)) bias[index] = pack(unpack(bias[index]) + added);
}
