// Mean and variance from compensated sums (kernels/shared/film.h).
#pragma once

#include <algorithm>

namespace sundog
{

struct Moments {
    double mean = 0.0;
    double variance = 0.0; // of one value, unbiased
};

// Of n values, from their sum and sum of squares, each with its rounding error.
inline Moments moments(float sum, float sum_error, float squares, float squares_error, double n)
{
    const double total = static_cast<double>(sum) + sum_error;
    const double total_squares = static_cast<double>(squares) + squares_error;
    const double mean = total / n;
    return {mean, n > 1 ? std::max(0.0, (total_squares - total * mean) / (n - 1)) : 0.0};
}

} // namespace sundog
