// Adds each pixel's splats, in the order of their paths, to radiance: sums in a fixed order give the same bits
// every time, which float atomics would not. Compensated, since one pixel may have all of a pass. One work-item a
// pixel. Used by ptracer and the bidirectional methods.
#include "math/compensated.h"
#include "shared/film.h"

__kernel void add_splats(__global const Splat* restrict splats, __global const uint* restrict order, __global const uint* restrict pixel_ends, uint ends_offset,
                         uint count, float inverse_paths, __global Vec3* restrict radiance)
{
    const uint pixel = get_global_id(0);
    if (pixel >= count) return;
    __global const uint* ends = pixel_ends + ends_offset;
    Vec3 sum = {0.0f, 0.0f, 0.0f}, error = {0.0f, 0.0f, 0.0f};
    for (uint i = pixel == 0u ? 0u : ends[pixel - 1u]; i < ends[pixel]; ++i) add_compensated3(&sum, &error, unpack(splats[order[i]].radiance));
    radiance[pixel] = pack(unpack(radiance[pixel]) + (unpack(sum) + unpack(error)) * inverse_paths);
}
