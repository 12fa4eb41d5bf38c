// Adds what queries found of the k nearest photons of a relaxed map (find_nearest_radii.cl). Relaxed photons are no Poisson process: they
// keep away from each other, and the disk that ends at the k-th holds k - 1/2 of them in the mean rather than k - 1. So
// a share of the k-th counts, half of it with the uniform kernel: `scale` is 1 + share / (k - 1). Disks of the radius
// `largest` were not ended by a photon. Reads queries and sums; updates radiance. One work-item a query. Used by photonmapper.
#include "math/vec3.h"
#include "shared/photon.h"

__kernel void add_relaxed(__global const GatherQuery* restrict queries, __global const GatherSum* restrict sums, uint count, float inverse_paths,
                          float largest, float scale, __global Vec3* restrict radiance)
{
    const uint index = get_global_id(0);
    if (index >= count || queries[index].radius == 0.0f) return;
    const float factor = queries[index].radius < largest ? scale * inverse_paths : inverse_paths;
    radiance[index] = pack(unpack(radiance[index]) + unpack(queries[index].throughput) * unpack(sums[index].flux) * factor);
}
