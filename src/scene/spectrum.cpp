#include "scene/spectrum.h"

#include "scene/cie_tables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sundog
{

namespace
{

constexpr int steps = 940; // midpoints every half nanometre

struct Xyz {
    double x = 0, y = 0, z = 0;
};

struct Cie {
    Xyz bar;
    double d65;
};

// The tables, linear in between; the wavelength must be in their range.
Cie cie_at(double wavelength)
{
    const auto rows = cie_rows();
    const double position = (wavelength - cie_lambda_min) / cie_lambda_step;
    const auto i = std::min(static_cast<std::size_t>(position), rows.size() - 2);
    const double t = position - static_cast<double>(i);
    const auto mix = [&](float CieRow::*column) {
        return (1.0 - t) * static_cast<double>(rows[i].*column) + t * static_cast<double>(rows[i + 1].*column);
    };
    return {{mix(&CieRow::x), mix(&CieRow::y), mix(&CieRow::z)}, mix(&CieRow::d65)};
}

// Integral of the matching functions against a function of wavelength (nm) and D65.
template <typename Function> Xyz integrate(Function&& value)
{
    Xyz sum;
    const double step = (cie_lambda_max - cie_lambda_min) / steps;
    for (int i = 0; i < steps; i++) {
        const double wavelength = cie_lambda_min + (i + 0.5) * step;
        const auto [bar, d65] = cie_at(wavelength);
        const double v = value(wavelength, d65) * step;
        sum.x += v * bar.x;
        sum.y += v * bar.y;
        sum.z += v * bar.z;
    }
    return sum;
}

// Luminance of the constant spectrum 1.
double equal_energy_luminance()
{
    static const double luminance = integrate([](double, double) { return 1.0; }).y;
    return luminance;
}

const Xyz& daylight()
{
    static const Xyz sum = integrate([](double, double d65) { return d65; });
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

Vec3 to_rgb(const Xyz& sum, double white_luminance)
{
    const double scale = 1.0 / white_luminance;
    return linear_srgb_from_xyz(sum.x * scale, sum.y * scale, sum.z * scale);
}

} // namespace

Vec3 cie_1931(double wavelength)
{
    if (!(wavelength >= cie_lambda_min && wavelength <= cie_lambda_max)) return {0, 0, 0};
    const Xyz bar = cie_at(wavelength).bar;
    return {static_cast<float>(bar.x), static_cast<float>(bar.y), static_cast<float>(bar.z)};
}

Vec3 linear_srgb_from_xyz(double x, double y, double z)
{
    return {static_cast<float>(3.240479 * x - 1.537150 * y - 0.498535 * z), static_cast<float>(-0.969256 * x + 1.875991 * y + 0.041556 * z),
            static_cast<float>(0.055648 * x - 0.204043 * y + 1.057311 * z)};
}

Vec3 index_to_rgb(std::span<const SpectrumSample> samples)
{
    const auto lit = integrate([&](double w, double d65) { return interpolate(samples, w) * d65; });
    const Vec3 colour = to_rgb(lit, daylight().y);
    const Vec3 white = to_rgb(daylight(), daylight().y); // (1, 1, 1) but for the rounding of the matrix
    return non_negative({colour.x / white.x, colour.y / white.y, colour.z / white.z});
}

Vec3 reflectance_to_rgb(std::span<const SpectrumSample> samples)
{
    return min(index_to_rgb(samples), Vec3{1, 1, 1});
}

Vec3 emission_to_rgb(std::span<const SpectrumSample> samples)
{
    return non_negative(to_rgb(integrate([&](double w, double) { return interpolate(samples, w); }), equal_energy_luminance()));
}

Vec3 blackbody_to_rgb(double kelvin)
{
    // Planck's law with the exact SI constants: B = 2 h c^2 / lambda^5 / (exp(h c / (lambda k T)) - 1).
    constexpr double c = 2.99792458e8, h = 6.62607015e-34, k = 1.380649e-23;
    const auto planck = [=](double nanometres, double) {
        const double lambda = nanometres * 1e-9;
        return 1e-9 * 2.0 * h * c * c / (std::pow(lambda, 5) * std::expm1(h * c / (lambda * k * kelvin)));
    };
    return non_negative(to_rgb(integrate(planck), equal_energy_luminance()));
}

} // namespace sundog
