#include "math/chi_squared.h"

#include <cmath>
#include <numbers>

namespace sundog
{

double chi_squared_tail(double statistic, int degrees)
{
    double sum = 0.0, term = 1.0;
    for (int j = 1; j < degrees; j += 2) {
        sum += term;
        term *= statistic / (j + 2);
    }
    return std::erfc(std::sqrt(0.5 * statistic)) + std::sqrt(2.0 * statistic / std::numbers::pi) * std::exp(-0.5 * statistic) * sum;
}

double chi_squared_quantile(double tail, int degrees)
{
    double low = 0.0, high = degrees;
    while (chi_squared_tail(high, degrees) > tail) high *= 2.0;
    for (int i = 0; i < 200 && low < high; i++) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        (chi_squared_tail(middle, degrees) > tail ? low : high) = middle;
    }
    return high;
}

} // namespace sundog
