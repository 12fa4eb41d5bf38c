// Adds an iteration's chain_radiance, times scale, to radiance. What it would be with a later scale is kept: chain_sum is the sum
// over iterations, correction that of (the latest scale - each iteration's) x chain_radiance. Clears chain_radiance. Samples that
// are not finite are left out. One work-item a pixel. Used by pssmlt.
#include "math/compensated.h"
#include "shared/film.h"

__kernel void add_chain_radiance(float scale, float scale_change, uint count, __global Vec3* restrict chain_radiance,
                                 __global DirectSum* restrict chain_sum, __global DirectSum* restrict correction,
                                 __global Vec3* restrict radiance)
{
    const uint pixel = get_global_id(0);
    if (pixel >= count) return;
    const float3 added = unpack(chain_radiance[pixel]);
    chain_radiance[pixel] = pack((float3)(0.0f));
    DirectSum sum = chain_sum[pixel], corrected = correction[pixel];
    add_compensated3(&corrected.sum, &corrected.error, (unpack(sum.sum) + unpack(sum.error)) * scale_change);
    if (is_finite3(added) && is_finite3(unpack(radiance[pixel]))) add_compensated3(&sum.sum, &sum.error, added);
    chain_sum[pixel] = sum;
    correction[pixel] = corrected;
    radiance[pixel] = pack(unpack(radiance[pixel]) + added * scale);
}
