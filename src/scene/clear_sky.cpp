#include "scene/clear_sky.h"

#include "scene/sky_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sundog
{

namespace
{

constexpr double half_pi = 0.5 * std::numbers::pi;
// One over the integral of the CIE's y(lambda) (nm), as Mitsuba 3 has it.
constexpr double per_cie_y = 1.0 / 106.7502593994140625;
// From the sun's spectral radiance to that of the data for sRGB.
constexpr double sun_to_rgb = 467.069280386;

// Linear between two entries of a table: the first one's index, and the weight of the second.
struct Between {
    std::size_t first;
    double weight;
};

Between between(double turbidity)
{
    const double place = std::clamp(turbidity - 1.0, 0.0, static_cast<double>(sky_table::turbidities - 1));
    const auto first = std::min(static_cast<std::size_t>(place), sky_table::turbidities - 2);
    return {first, place - static_cast<double>(first)};
}

// Bernstein's polynomials of degree 5.
std::array<double, sky_table::elevations> bernstein(double x)
{
    constexpr std::array<double, sky_table::elevations> binomials{1, 5, 10, 10, 5, 1};
    std::array<double, sky_table::elevations> weights{};
    for (std::size_t i = 0; i < weights.size(); i++)
        weights[i] = binomials[i] * std::pow(x, static_cast<double>(i)) * std::pow(1.0 - x, static_cast<double>(weights.size() - 1 - i));
    return weights;
}

// A value of the table by turbidity, albedo and elevation: linear in the first two, a Bezier curve over the third.
template <class Table>
double interpolate(Between turbidity, double albedo, const std::array<double, sky_table::elevations>& weights, Table table)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < weights.size(); i++) {
        const auto at = [&](std::size_t t) { return std::lerp(table(t, 0, i), table(t, 1, i), albedo); };
        sum += weights[i] * std::lerp(at(turbidity.first), at(turbidity.first + 1), turbidity.weight);
    }
    return sum;
}

Vec3 radiance(const std::array<double, 3>& c)
{
    const auto positive = [](double value) { return static_cast<float>(std::max(value * per_cie_y, 0.0)); };
    return {positive(c[0]), positive(c[1]), positive(c[2])};
}

} // namespace

ClearSky::ClearSky(double turbidity, Vec3 albedo, double sun_elevation)
{
    const Between t = between(turbidity);
    const auto weights = bernstein(std::cbrt(std::clamp(sun_elevation / half_pi, 0.0, 1.0)));
    const double albedos[] = {albedo.x, albedo.y, albedo.z};
    for (std::size_t c = 0; c < channels_.size(); c++) {
        for (std::size_t p = 0; p < sky_table::sky_parameters; p++) {
            channels_[c].parameters[p] =
                interpolate(t, albedos[c], weights, [&](std::size_t at, std::size_t ground, std::size_t i) -> double {
                    return sky_table::sky_parameter(at, ground, i, c, p);
                });
        }
        channels_[c].radiance = interpolate(t, albedos[c], weights, [&](std::size_t at, std::size_t ground, std::size_t i) -> double {
            return sky_table::sky_radiance(at, ground, i, c);
        });
    }
    for (std::size_t s = 0; s < sky_table::sun_segments; s++)
        for (std::size_t c = 0; c < sky_table::channels; c++)
            for (std::size_t p = 0; p < sky_table::sun_powers; p++)
                for (std::size_t l = 0; l < sky_table::limb_powers; l++) {
                    const double low = sky_table::sun_radiance(t.first, s, c, p, l),
                                 high = sky_table::sun_radiance(t.first + 1, s, c, p, l);
                    sun_.push_back(std::lerp(low, high, t.weight));
                }
}

// [Hosek and Wilkie 2012] eq. 8 and 9; here as in their code, where G and H of the paper are parameters 6 and 8.
Vec3 ClearSky::sky(double cos_zenith, double gamma) const
{
    const double cos_gamma = std::cos(gamma), cosine = std::max(cos_zenith, 0.0);
    std::array<double, 3> result{};
    for (std::size_t c = 0; c < result.size(); c++) {
        const auto& p = channels_[c].parameters;
        const double mie = (1.0 + cos_gamma * cos_gamma) / std::pow(1.0 + p[8] * p[8] - 2.0 * p[8] * cos_gamma, 1.5);
        result[c] = channels_[c].radiance * (1.0 + p[0] * std::exp(p[1] / (cosine + 0.01))) *
                    (p[2] + p[3] * std::exp(p[4] * gamma) + p[5] * cos_gamma * cos_gamma + p[6] * mie + p[7] * std::sqrt(cosine));
    }
    return radiance(result);
}

// [Hosek and Wilkie 2013]: a polynomial in the elevation within each of 45 segments, which are narrower near the horizon,
// times one in cos_psi for the darkening towards the limb.
Vec3 ClearSky::sun(double elevation, double cos_psi) const
{
    constexpr auto segments = static_cast<double>(sky_table::sun_segments);
    const double place = std::cbrt(std::clamp(elevation / half_pi, 0.0, 1.0)) * segments;
    const std::size_t segment = std::min(static_cast<std::size_t>(place), sky_table::sun_segments - 1);
    const double x = std::max(elevation, 0.0) - half_pi * std::pow(static_cast<double>(segment) / segments, 3.0);
    std::array<double, 3> result{};
    const double* coefficient = &sun_[segment * sky_table::channels * sky_table::sun_powers * sky_table::limb_powers];
    for (double& channel : result) {
        double power = sun_to_rgb;
        for (std::size_t p = 0; p < sky_table::sun_powers; p++, power *= x) {
            double limb = power;
            for (std::size_t l = 0; l < sky_table::limb_powers; l++, limb *= cos_psi) channel += limb * *coefficient++;
        }
    }
    return radiance(result);
}

} // namespace sundog
