// Pearson's chi-squared test: whether counts follow the expected ones.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace sundog
{

// Regularised upper incomplete gamma function Q(a, x), a > 0, x >= 0: by its series where that converges quickly,
// by Legendre's continued fraction (evaluated with Lentz's method) elsewhere.
inline double upper_gamma_fraction(double a, double x)
{
    if (x <= 0.0) return 1.0;
    const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
    constexpr int most_terms = 100'000;
    if (x < a + 1.0) {
        double term = 1.0 / a, sum = term;
        for (int n = 1; n < most_terms && term > sum * 1e-16; ++n) sum += term *= x / (a + n);
        return std::max(0.0, 1.0 - scale * sum);
    }
    constexpr double tiny = 1e-300;
    double b = x + 1.0 - a, c = 1.0 / tiny, d = 1.0 / b, fraction = d;
    for (int n = 1; n < most_terms; ++n) {
        const double numerator = -n * (n - a);
        b += 2.0;
        d = numerator * d + b;
        d = 1.0 / (std::abs(d) < tiny ? tiny : d);
        c = b + numerator / c;
        if (std::abs(c) < tiny) c = tiny;
        fraction *= d * c;
        if (std::abs(d * c - 1.0) < 1e-15) break;
    }
    return scale * fraction;
}

// Probability that a chi-squared variable of so many degrees of freedom exceeds `statistic`.
inline double chi_squared_p_value(double statistic, int degrees)
{
    return upper_gamma_fraction(0.5 * degrees, 0.5 * statistic);
}

struct ChiSquaredResult {
    double statistic = 0.0;
    int degrees = 0;
    double p = 1.0;
};

// Bins of fewer than `least_expected` expected counts are pooled, smallest first. A count where none can be has p = 0.
inline ChiSquaredResult chi_squared(std::span<const double> observed, std::span<const double> expected, double least_expected = 5.0)
{
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
    ChiSquaredResult result;
    double pooled_observed = 0.0, pooled_expected = 0.0;
    int bins = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t bin = order[i];
        if (expected[bin] == 0.0 && observed[bin] > 0.0) return {INFINITY, 1, 0.0};
        pooled_observed += observed[bin];
        pooled_expected += expected[bin];
        if (pooled_expected < least_expected) continue;
        result.statistic += (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
        pooled_observed = pooled_expected = 0.0;
        ++bins;
    }
    result.degrees = bins - 1;
    if (result.degrees > 0) result.p = chi_squared_p_value(result.statistic, result.degrees);
    return result;
}

// Level of one test such that all `tests` together reject a true hypothesis with probability 0.01 [Sidak 1967].
inline double sidak_level(int tests)
{
    return -std::expm1(std::log1p(-0.01) / tests);
}

// Whether counts follow the expectation, one of `tests` tests. The expected counts must add up to the observed
// ones within `total_tolerance` (relative), for they come from densities that must integrate to 1.
inline testing::AssertionResult follows(std::span<const double> observed, std::span<const double> expected, int tests,
                                        double total_tolerance = 1e-3)
{
    if (observed.size() != expected.size())
        return testing::AssertionFailure() << observed.size() << " bins, " << expected.size() << " expected";
    const double total = std::accumulate(observed.begin(), observed.end(), 0.0);
    const double expected_total = std::accumulate(expected.begin(), expected.end(), 0.0);
    if (!(std::abs(total - expected_total) <= total_tolerance * total))
        return testing::AssertionFailure() << "the expected counts add up to " << expected_total << " instead of " << total;
    const ChiSquaredResult result = chi_squared(observed, expected);
    if (result.degrees < 1) return testing::AssertionFailure() << "too few counts for a test";
    if (!(result.p > sidak_level(tests)))
        return testing::AssertionFailure() << "chi squared " << result.statistic << " with " << result.degrees
                                           << " degrees of freedom, p = " << result.p;
    return testing::AssertionSuccess() << "p = " << result.p;
}

// The same when every bin is as likely.
inline testing::AssertionResult is_uniform(std::span<const double> observed, int tests)
{
    const double total = std::accumulate(observed.begin(), observed.end(), 0.0);
    return follows(observed, std::vector<double>(observed.size(), total / static_cast<double>(observed.size())), tests);
}

} // namespace sundog
