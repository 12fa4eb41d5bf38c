// Adds an iteration without its estimated bias to sums of their own, so that their variance holds the noise of the
// estimated bias as well. Reads radiance; updates corrected; clears bias. Leaves out what the film leaves out. One
// work-item a pixel. Used where errors of biased methods are estimated.
#include "math/compensated.h"
#include "shared/film.h"

__kernel void accumulate_corrected(__global const Vec3* restrict radiance, uint count, __global Vec3* restrict bias,
                                   __global FilmPixel* restrict corrected)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const float3 sample = unpack(radiance[index]) - unpack(bias[index]);
    bias[index] = pack((float3)(0.0f));
    if (!is_finite3(sample)) return;
    FilmPixel pixel = corrected[index];
    add_compensated3(&pixel.sum, &pixel.sum_error, sample);
    add_squares_compensated3(&pixel.squares, &pixel.squares_error, sample);
    corrected[index] = pixel;
}
