// Adds each pixel's splats, each times the weight of its sample, in the order that they were left: as independent samples to
// radiance, as the chains' to chain_radiance. One work-item a pixel. Used by pssmlt.
#include "math/compensated.h"
#include "shared/film.h"
#include "shared/markov_chain.h"

__kernel void add_weighted_splats(__global const Splat* restrict splats, __global const uint* restrict samples,
                                  __global const SampleWeight* restrict weights, __global const uint* restrict order,
                                  __global const uint* restrict pixel_ends, uint ends_offset, uint count, float scale,
                                  __global Vec3* restrict radiance, __global Vec3* restrict chain_radiance)
{
    const uint pixel = get_global_id(0);
    if (pixel >= count) return;
    __global const uint* ends = pixel_ends + ends_offset;
    Vec3 sum = {0.0f, 0.0f, 0.0f}, error = {0.0f, 0.0f, 0.0f};
    Vec3 chain_sum = {0.0f, 0.0f, 0.0f}, chain_error = {0.0f, 0.0f, 0.0f};
    for (uint i = pixel == 0u ? 0u : ends[pixel - 1u]; i < ends[pixel]; ++i) {
        const uint splat = order[i];
        const SampleWeight weight = weights[samples[splat]];
        const float3 value = unpack(splats[splat].radiance);
        if (weight.independent > 0.0f) add_compensated3(&sum, &error, value * weight.independent);
        if (weight.chain > 0.0f) add_compensated3(&chain_sum, &chain_error, value * weight.chain);
    }
    radiance[pixel] = pack(unpack(radiance[pixel]) + (unpack(sum) + unpack(error)) * scale);
    chain_radiance[pixel] = pack(unpack(chain_radiance[pixel]) + (unpack(chain_sum) + unpack(chain_error)) * scale);
}
