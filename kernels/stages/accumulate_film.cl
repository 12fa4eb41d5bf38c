// Adds an iteration to the film. Reads radiance; updates sums and sums of squares; counts and leaves out
// samples that are not finite. One work-item a pixel. Used by every method.
#include "math/compensated.h"
#include "shared/film.h"

__kernel void accumulate_film(__global const Vec3* restrict radiance, uint count, __global FilmPixel* restrict film, __global uint* restrict invalid_samples)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const float3 sample = unpack(radiance[index]);
    if (!is_finite3(sample)) {
        atomic_inc(invalid_samples);
        return;
    }
    FilmPixel pixel = film[index];
    add_compensated3(&pixel.sum, &pixel.sum_error, sample);
    add_squares_compensated3(&pixel.squares, &pixel.squares_error, sample);
    film[index] = pixel;
}
