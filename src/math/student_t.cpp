#include "math/student_t.h"

#include <cmath>
#include <initializer_list>

namespace sundog
{

namespace
{

// Continued fraction of the incomplete beta function [Abramowitz and Stegun 1964, eq. 26.5.8], by the modified method of
// Lentz. Converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x)
{
    constexpr double tiny = 1e-300, precision = 1e-15;
    const auto nonzero = [](double value) { return std::abs(value) < tiny ? tiny : value; };
    double c = 1.0, d = 1.0 / nonzero(1.0 - (a + b) * x / (a + 1.0)), fraction = d;
    for (int m = 1; m < 10000; m++) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        double step = 1.0;
        for (const double coefficient : {even, odd}) {
            d = 1.0 / nonzero(1.0 + coefficient * d);
            c = nonzero(1.0 + coefficient / c);
            step = c * d;
            fraction *= step;
        }
        if (std::abs(step - 1.0) < precision) break;
    }
    return fraction;
}

// I_x(a, b), where y is 1 - x without its rounding.
double incomplete_beta(double a, double b, double x, double y)
{
    if (x <= 0.0) return 0.0;
    if (y <= 0.0) return 1.0;
    const double factor = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log(y));
    if (x < (a + 1.0) / (a + b + 2.0)) return factor * beta_fraction(a, b, x) / a;
    return 1.0 - factor * beta_fraction(b, a, y) / b;
}

} // namespace

double student_t_tail(double t, double degrees)
{
    const double sum = degrees + t * t;
    return 0.5 * incomplete_beta(0.5 * degrees, 0.5, degrees / sum, t * t / sum);
}

double student_t_quantile(double tail, double degrees)
{
    double low = 0.0, high = 2.0;
    while (student_t_tail(high, degrees) > tail) high *= 2.0;
    for (int i = 0; i < 200; i++) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        (student_t_tail(middle, degrees) > tail ? low : high) = middle;
    }
    return high;
}

} // namespace sundog
