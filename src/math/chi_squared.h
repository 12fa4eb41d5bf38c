// The chi-squared distribution, as far as tests of photons need it.
#pragma once

namespace sundog
{

// Probability that a chi-squared variable of `degrees` degrees of freedom, which must be odd, exceeds `statistic` >= 0
// [Abramowitz and Stegun 1964, eq. 26.4.4].
double chi_squared_tail(double statistic, int degrees);

// The statistic that is exceeded with the given probability, in (0, 1].
double chi_squared_quantile(double tail, int degrees);

} // namespace sundog
