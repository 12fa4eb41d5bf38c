// Whether two noisy images can have the same expectation. Every threshold follows from the images' own variances and
// from the probability with which right images may be rejected.
#pragma once

#include "reference/noisy_image.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>

namespace sundog::test
{

// A relative difference that is let pass beside the noise: half floats round the reference by up to 2^-11 = 0.05 %, and
// both renderers add up 32-bit floats.
constexpr double relative_tolerance = 1e-3;

// Probability that Student's |t| exceeds `t` > 0. With t = sqrt(degrees) tan(a) the density is proportional to
// cos(a)^(degrees - 1), which Simpson's rule integrates from there to pi/2 without cancellation. Beyond 1000 degrees
// of freedom those of 1000 are taken, which errs on the side of acceptance.
inline double student_two_sided_p(double t, double degrees)
{
    degrees = std::clamp(degrees, 1.0, 1000.0);
    const double from = std::atan(t / std::sqrt(degrees)), to = 0.5 * std::numbers::pi;
    const double norm = std::exp(std::lgamma(0.5 * (degrees + 1)) - std::lgamma(0.5 * degrees)) / std::sqrt(std::numbers::pi);
    const auto density = [&](double a) { return std::pow(std::max(std::cos(a), 0.0), degrees - 1); };
    constexpr int steps = 2000;
    double sum = density(from) + density(to);
    for (int i = 1; i < steps; i++) sum += density(from + (to - from) * i / steps) * (i % 2 ? 4.0 : 2.0);
    return std::min(1.0, 2.0 * norm * sum * (to - from) / steps / 3.0);
}

// Smallest t that is exceeded with at most this probability.
inline double student_two_sided_quantile(double degrees, double p)
{
    double low = 0.0, high = 1.0;
    while (student_two_sided_p(high, degrees) > p) high *= 2.0;
    for (int i = 0; i < 60; i++) (student_two_sided_p(0.5 * (low + high), degrees) > p ? low : high) = 0.5 * (low + high);
    return high;
}

inline Measured difference(const Measured& a, const Measured& b)
{
    MeasuredSum sum;
    sum.add(a, 1.0);
    sum.add(b, -1.0);
    return sum.result();
}

// Squares of 8, 16 and 32 pixels, each size tiling the image, and the whole image.
inline std::vector<Region> regions_of(int width, int height)
{
    std::vector<Region> regions;
    for (int side = block_side; side <= 4 * block_side; side *= 2)
        for (int y = 0; y < height; y += side)
            for (int x = 0; x < width; x += side) regions.push_back({x, y, std::min(x + side, width), std::min(y + side, height)});
    regions.push_back({0, 0, width, height});
    return regions;
}

// A t-test for each channel of each region, with Bonferroni's correction: right images fail with probability `level`.
inline testing::AssertionResult regions_agree(const NoisyImage& image, const NoisyImage& reference, double level)
{
    const auto regions = regions_of(image.width, image.height);
    const double level_of_one = level / (3.0 * static_cast<double>(regions.size()));
    std::string worst;
    double smallest = 1.0;
    int rejected = 0;
    for (const Region& region : regions)
        for (int channel = 0; channel < 3; channel++) {
            const Measured a = image.mean(region, channel), b = reference.mean(region, channel), d = difference(a, b);
            const double excess = std::abs(d.mean) - relative_tolerance * std::abs(b.mean);
            if (!(excess > 0.0)) continue;
            const double p = d.variance > 0.0 ? student_two_sided_p(excess / std::sqrt(d.variance), d.degrees) : 0.0;
            if (p < level_of_one) rejected++;
            if (p >= smallest) continue;
            smallest = p;
            worst =
                fmt::format("{} of [{}, {}) x [{}, {}): {:.5g} +- {:.2g}, reference {:.5g} +- {:.2g}, p = {:.2g}", "RGB"[channel],
                            region.x0, region.x1, region.y0, region.y1, a.mean, std::sqrt(a.variance), b.mean, std::sqrt(b.variance), p);
        }
    if (rejected == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << rejected << " of " << 3 * regions.size() << " means differ (p < " << level_of_one
                                       << "); the worst: " << worst;
}

// sundog compare's relmse, less what both images' noise adds to it: sum of (d^2 - variance of d) / (reference^2 + 0.01)
// over pixels and channels, whose expectation is the relmse of the bias alone. Its own variance is estimated from the
// pixels, which are independent; the terms are skewed to the right, which makes rejections by chance only rarer.
struct BiasRelmse {
    double value = 0.0, standard_error = 0.0;
    double of_noise = 0.0; // relmse that two right images have
};

inline BiasRelmse bias_relmse(const NoisyImage& image, const NoisyImage& reference)
{
    BiasRelmse result;
    double squares = 0.0;
    const double n = 3.0 * image.width * image.height;
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++) {
            double excess = 0.0; // of the pixel: its channels are not independent of each other
            for (int channel = 0; channel < 3; channel++) {
                const Measured d = difference(image.pixel(x, y, channel), reference.pixel(x, y, channel));
                const double squared = std::pow(reference.pixel(x, y, channel).mean, 2);
                const double weight = 1.0 / (squared + 0.01) / n;
                excess += weight * (d.mean * d.mean - d.variance - relative_tolerance * relative_tolerance * squared);
                result.of_noise += weight * d.variance;
            }
            result.value += excess;
            squares += excess * excess;
        }
    result.standard_error = std::sqrt(squares);
    return result;
}

// One-sided: right images fail with probability `level`.
inline testing::AssertionResult relmse_agrees(const NoisyImage& image, const NoisyImage& reference, double level)
{
    const BiasRelmse relmse = bias_relmse(image, reference);
    const double bound = student_two_sided_quantile(1000.0, 2.0 * level) * relmse.standard_error;
    if (relmse.value <= bound) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "relmse " << relmse.of_noise + relmse.value << " exceeds that of the noise, " << relmse.of_noise
                                       << ", by more than " << bound;
}

// The relative error of a 16x16 region that would be found for sure, in the median over the image: what the test can see.
inline double typical_sensitivity(const NoisyImage& image, const NoisyImage& reference, double level)
{
    std::vector<double> errors;
    const auto regions = regions_of(image.width, image.height);
    for (const Region& region : regions) {
        if (region.x1 - region.x0 != 2 * block_side) continue;
        const Measured b = reference.mean(region, 1), d = difference(image.mean(region, 1), b);
        if (b.mean > 0.0)
            errors.push_back(relative_tolerance +
                             student_two_sided_quantile(d.degrees, level / (3.0 * static_cast<double>(regions.size()))) *
                                 std::sqrt(d.variance) / b.mean);
    }
    if (errors.empty()) return INFINITY;
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
    return errors[errors.size() / 2];
}

} // namespace sundog::test
