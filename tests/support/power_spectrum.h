// How unevenly points lie, by frequency.
#pragma once

#include "shared/photon.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace sundog
{

// The mean over `samples` frequencies from `low` to `high`, as multiples of the root of the density, of the periodogram
// |sum exp(-2 pi i f . x)|^2 / n of the points with |x|, |y| < half_side. Frequencies are multiples of 1 / (2 half_side), of which
// even light has none: points that chance alone has put there have a mean of 1, with a standard error of 1 / sqrt(samples).
inline double mean_power(const std::vector<Photon>& photons, double half_side, double low, double high, int samples, std::mt19937& random)
{
    std::vector<std::pair<double, double>> inside;
    for (const Photon& photon : photons) {
        const double x = photon.position.x, y = photon.position.y;
        if (std::abs(x) < half_side && std::abs(y) < half_side) inside.emplace_back(x, y);
    }
    const double side = 2.0 * half_side, n = static_cast<double>(inside.size()),
                 unit = std::sqrt(n); // unit: root of the density, in 1 / side
    std::uniform_real_distribution<double> square(low * low, high * high), turn(0.0, 2.0 * std::numbers::pi);
    double sum = 0.0;
    for (int i = 0; i < samples; i++) {
        const double f = unit * std::sqrt(square(random)), angle = turn(random);
        const double fx = std::round(f * std::cos(angle)) / side, fy = std::round(f * std::sin(angle)) / side;
        double real = 0.0, imaginary = 0.0;
        for (const auto& [x, y] : inside) {
            const double phase = 2.0 * std::numbers::pi * (fx * x + fy * y);
            real += std::cos(phase);
            imaginary += std::sin(phase);
        }
        sum += (real * real + imaginary * imaginary) / n;
    }
    return sum / samples;
}

} // namespace sundog
