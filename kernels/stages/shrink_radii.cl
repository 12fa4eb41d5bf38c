// Local radii: each pixel's shrinks by the photons that its query has found. Reads queries and sums; updates pixels. One
// work-item a pixel. Used with radius_policy=local.
#include "density/photon_count.h"
#include "shared/counted_radius.h"
#include "shared/photon.h"

__kernel void shrink_radii(__global const GatherQuery* restrict queries, __global const GatherSum* restrict sums, uint count, float alpha,
                           __global CountedPixel* restrict pixels)
{
    const uint index = get_global_id(0);
    if (index >= count || queries[index].radius == 0.0f || sums[index].count == 0.0f) return;
    CountedPixel pixel = pixels[index];
    pixel.radius_squared *= keep_photons(&pixel.count, &pixel.count_error, sums[index].count, alpha);
    pixels[index] = pixel;
}
