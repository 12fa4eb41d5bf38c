// Sums squared relative errors over pixels: of the bound |B| + t S / sqrt(n), of the bias B and of the standard error.
// Reads the film and, with -D BIASED=1, the sums without estimated bias, whose difference from the film's is n B and whose
// variance is S^2; writes one partial sum an item. Item i takes pixels i, i + items, ...: the order is fixed. Used where
// errors are estimated.
#include "shared/error_estimate.h"
#include "shared/film.h"

// One channel's sums over iterations, each with its rounding error.
typedef struct Sums {
    float sum, sum_error, squares, squares_error;
} Sums;

// S^2 / n = (n q - s^2) / (n^2 (n - 1)), where the difference of the products may be a millionth of them: their rounding
// errors come by fma, and the sums' own stay beside them.
static inline float variance_of_mean(Sums sums, float n)
{
#pragma OPENCL FP_CONTRACT OFF
    const float a = n * sums.squares, b = sums.sum * sums.sum;
    const float a_error = fma(n, sums.squares, -a) + n * sums.squares_error;
    const float b_error = fma(sums.sum, sums.sum, -b) + 2.0f * sums.sum * sums.sum_error;
    const float difference = (a - b) + (a_error - b_error);
    return fmax(difference, 0.0f) / (n * n * (n - 1.0f));
}

static inline void add_channel(RelativeSquares* total, Sums film, Sums corrected, float n, float quantile)
{
    const float mean = (film.sum + film.sum_error) / n;
    const float bias = BIASED ? ((film.sum - corrected.sum) + (film.sum_error - corrected.sum_error)) / n : 0.0f;
    const float noise = variance_of_mean(film, n);
    const float bound = fabs(bias) + quantile * sqrt(BIASED ? variance_of_mean(corrected, n) : noise);
    const float weight = 1.0f / (mean * mean + RELATIVE_ERROR_OFFSET);
    total->bound += bound * bound * weight;
    total->bias += bias * bias * weight;
    total->noise += noise * weight;
}

static inline Sums make_sums(float sum, float sum_error, float squares, float squares_error)
{
    const Sums sums = {sum, sum_error, squares, squares_error};
    return sums;
}

#define CHANNEL(pixel, c) make_sums((pixel).sum.c, (pixel).sum_error.c, (pixel).squares.c, (pixel).squares_error.c)

__kernel void sum_error_bounds(__global const FilmPixel* film, __global const FilmPixel* corrected, uint count, float n, float quantile,
                               uint items, __global RelativeSquares* restrict sums)
{
    const uint item = get_global_id(0);
    if (item >= items) return;
    RelativeSquares total = {0.0f, 0.0f, 0.0f};
    for (uint index = item; index < count; index += items) {
        const FilmPixel with_bias = film[index], without = corrected[index];
        add_channel(&total, CHANNEL(with_bias, x), CHANNEL(without, x), n, quantile);
        add_channel(&total, CHANNEL(with_bias, y), CHANNEL(without, y), n, quantile);
        add_channel(&total, CHANNEL(with_bias, z), CHANNEL(without, z), n, quantile);
    }
    sums[item] = total;
}
