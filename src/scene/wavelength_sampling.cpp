#include "scene/wavelength_sampling.h"

#include "math/mix_bits.h"
#include "scene/spectral_basis.h"
#include "scene/spectrum.h"

#include <algorithm>

namespace sundog {

namespace {

constexpr std::size_t bins = 470; // of one nanometre
static_assert(shortest_wavelength + static_cast<double>(bins) == longest_wavelength);

struct Distribution {
    std::array<double, bins> density;    // 1/nm
    std::array<double, bins + 1> shares; // below each bin's start
};

const Distribution& distribution()
{
    static const Distribution table = [] {
        Distribution d{};
        double sum = 0.0;
        for (std::size_t i = 0; i < bins; i++) {
            const double wavelength = shortest_wavelength + static_cast<double>(i) + 0.5;
            const Vec3 xyz = cie_1931(wavelength);
            d.density[i] = d65(wavelength) * (static_cast<double>(xyz.x) + xyz.y + xyz.z);
            sum += d.density[i];
        }
        for (std::size_t i = 0; i < bins; i++) {
            d.density[i] /= sum;
            d.shares[i + 1] = d.shares[i] + d.density[i];
        }
        return d;
    }();
    return table;
}

Vec3 as_row(const Double3& v, double scale)
{
    return {static_cast<float>(v[0] * scale), static_cast<float>(v[1] * scale), static_cast<float>(v[2] * scale)};
}

} // namespace

double wavelength_density(double wavelength)
{
    if (!(wavelength >= shortest_wavelength && wavelength < longest_wavelength)) return 0.0;
    return distribution().density[static_cast<std::size_t>(wavelength - shortest_wavelength)];
}

double wavelength_at(double share)
{
    const Distribution& d = distribution();
    const auto above = std::upper_bound(d.shares.begin() + 1, d.shares.end() - 1, share);
    const std::size_t bin = static_cast<std::size_t>(above - d.shares.begin()) - 1;
    const double within = std::clamp((share - d.shares[bin]) / d.density[bin], 0.0, 1.0);
    return std::min(shortest_wavelength + static_cast<double>(bin) + within, longest_wavelength);
}

std::array<double, wavelengths_of_a_pass> pass_wavelengths(std::uint64_t seed, std::uint64_t pass)
{
    constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15u; // its fraction, times 2^64
    const std::uint64_t place = mix_bits(seed + golden_ratio) + pass * golden_ratio;
    const double u = static_cast<double>(place >> 11) * 0x1p-53;
    return {wavelength_at(u / 3.0), wavelength_at((u + 1.0) / 3.0), wavelength_at((u + 2.0) / 3.0)};
}

Wavelengths make_wavelengths(const std::array<double, wavelengths_of_a_pass>& wavelengths)
{
    Wavelengths result{};
    Double3 to_rgb[wavelengths_of_a_pass];
    for (std::size_t k = 0; k < wavelengths_of_a_pass; k++) {
        const double wavelength = wavelengths[k];
        result.reflectance[k] = as_row(reflectance_basis(wavelength), 1.0);
        result.emission[k] = as_row(reflectance_basis(wavelength), d65(wavelength));
        // A bin's own density, also where the last one ends.
        const double density = wavelength_density(std::min(wavelength, longest_wavelength - 0.5));
        const Double3 matching = rgb_matching(wavelength);
        for (std::size_t c = 0; c < 3; c++) to_rgb[k][c] = matching[c] / (wavelengths_of_a_pass * density);
    }
    result.micrometres = as_row(wavelengths, 1e-3);
    for (std::size_t c = 0; c < 3; c++) result.to_rgb[c] = as_row({to_rgb[0][c], to_rgb[1][c], to_rgb[2][c]}, 1.0);
    return result;
}

} // namespace sundog
