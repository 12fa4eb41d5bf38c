#include "scene/spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sundog
{

namespace
{

constexpr double lambda_min = 360.0; // nm, of the visible range as CIE tabulates it
constexpr double lambda_max = 830.0;
constexpr int steps = 940; // midpoints every half nanometre

struct Xyz {
    double x = 0, y = 0, z = 0;
};

// A Gaussian whose two halves have their own inverse widths.
double lobe(double wavelength, double centre, double below, double above)
{
    const double t = (wavelength - centre) * (wavelength < centre ? below : above);
    return std::exp(-0.5 * t * t);
}

Xyz matching(double l)
{
    return {1.056 * lobe(l, 599.8, 0.0264, 0.0323) + 0.362 * lobe(l, 442.0, 0.0624, 0.0374) - 0.065 * lobe(l, 501.1, 0.0490, 0.0382),
            0.821 * lobe(l, 568.8, 0.0213, 0.0247) + 0.286 * lobe(l, 530.9, 0.0613, 0.0322),
            1.217 * lobe(l, 437.0, 0.0845, 0.0278) + 0.681 * lobe(l, 459.0, 0.0385, 0.0725)};
}

// Integral of the matching functions against a function of wavelength (nm).
template <typename Function> Xyz integrate(Function&& value)
{
    Xyz sum;
    const double step = (lambda_max - lambda_min) / steps;
    for (int i = 0; i < steps; i++) {
        const double wavelength = lambda_min + (i + 0.5) * step;
        const double v = value(wavelength) * step;
        const Xyz bar = matching(wavelength);
        sum.x += v * bar.x;
        sum.y += v * bar.y;
        sum.z += v * bar.z;
    }
    return sum;
}

// Colour of the constant spectrum 1.
const Xyz& equal_energy()
{
    static const Xyz sum = integrate([](double) { return 1.0; });
    return sum;
}

double interpolate(std::span<const SpectrumSample> samples, double wavelength)
{
    if (wavelength < samples.front().wavelength || wavelength > samples.back().wavelength) return 0.0;
    auto after = std::upper_bound(samples.begin(), samples.end(), wavelength,
                                  [](double w, const SpectrumSample& sample) { return w < sample.wavelength; });
    if (after == samples.end()) return samples.back().value;
    const auto before = after - 1;
    const double t = (wavelength - before->wavelength) / (after->wavelength - before->wavelength);
    return before->value + t * (after->value - before->value);
}

Vec3 non_negative(Vec3 colour)
{
    return max(colour, Vec3{0, 0, 0});
}

Vec3 normalized_to_rgb(const Xyz& sum)
{
    const double scale = 1.0 / equal_energy().y;
    return linear_srgb_from_xyz(sum.x * scale, sum.y * scale, sum.z * scale);
}

} // namespace

Vec3 cie_1931(double wavelength)
{
    const Xyz bar = matching(wavelength);
    return {static_cast<float>(bar.x), static_cast<float>(bar.y), static_cast<float>(bar.z)};
}

Vec3 linear_srgb_from_xyz(double x, double y, double z)
{
    return {static_cast<float>(3.240479 * x - 1.537150 * y - 0.498535 * z), static_cast<float>(-0.969256 * x + 1.875991 * y + 0.041556 * z),
            static_cast<float>(0.055648 * x - 0.204043 * y + 1.057311 * z)};
}

Vec3 index_to_rgb(std::span<const SpectrumSample> samples)
{
    const Vec3 colour = normalized_to_rgb(integrate([&](double w) { return interpolate(samples, w); }));
    const Vec3 white = normalized_to_rgb(equal_energy());
    return non_negative({colour.x / white.x, colour.y / white.y, colour.z / white.z});
}

Vec3 reflectance_to_rgb(std::span<const SpectrumSample> samples)
{
    return min(index_to_rgb(samples), Vec3{1, 1, 1});
}

Vec3 emission_to_rgb(std::span<const SpectrumSample> samples)
{
    return non_negative(normalized_to_rgb(integrate([&](double w) { return interpolate(samples, w); })));
}

Vec3 blackbody_to_rgb(double kelvin)
{
    // Planck's law with the exact SI constants: B = 2 h c^2 / lambda^5 / (exp(h c / (lambda k T)) - 1).
    constexpr double c = 2.99792458e8, h = 6.62607015e-34, k = 1.380649e-23;
    const auto planck = [=](double nanometres) {
        const double lambda = nanometres * 1e-9;
        return 1e-9 * 2.0 * h * c * c / (std::pow(lambda, 5) * std::expm1(h * c / (lambda * k * kelvin)));
    };
    return non_negative(normalized_to_rgb(integrate(planck)));
}

} // namespace sundog
