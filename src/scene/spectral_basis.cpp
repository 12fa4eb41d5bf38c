#include "scene/spectral_basis.h"

#include "scene/cie_tables.h"
#include "scene/spectrum.h"

#include <algorithm>
#include <array>
#include <span>

namespace sundog {

namespace {

constexpr int steps = 940; // midpoints every half nanometre

double interpolate(const double (&table)[spectral_nodes], double wavelength)
{
    const double place = (wavelength - shortest_wavelength) / spectral_step;
    if (!(place >= 0.0 && place <= spectral_nodes - 1)) return 0.0;
    const int node = std::min(static_cast<int>(place), spectral_nodes - 2);
    const double t = place - node;
    return table[node] * (1.0 - t) + table[node + 1] * t;
}

Double3 unscaled_matching(double wavelength)
{
    const Vec3 xyz = cie_1931(wavelength);
    const Vec3 rgb = linear_srgb_from_xyz(static_cast<double>(xyz.x), static_cast<double>(xyz.y), static_cast<double>(xyz.z));
    return {static_cast<double>(rgb.x), static_cast<double>(rgb.y), static_cast<double>(rgb.z)};
}

using Matrix = std::array<Double3, 3>; // rows

Matrix inverse(const Matrix& m)
{
    const Double3 columns[3] = {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
    const double determinant = dot(m[0], columns[0]);
    Matrix result{};
    for (std::size_t row = 0; row < 3; row++)
        for (std::size_t column = 0; column < 3; column++) result[row][column] = columns[column][row] / determinant;
    return result;
}

// From what the curves make of light to linear sRGB in which the basis under D65 is exactly (1, 0, 0), (0, 1, 0) and
// (0, 0, 1). Next to a multiple of the identity: beyond scale, what roundings leave over.
const Matrix& correction()
{
    static const Matrix matrix = [] {
        Matrix seen{};
        const double step = (longest_wavelength - shortest_wavelength) / steps;
        for (int i = 0; i < steps; i++) {
            const double wavelength = shortest_wavelength + (i + 0.5) * step;
            const Double3 matching = unscaled_matching(wavelength), basis = reflectance_basis(wavelength);
            for (std::size_t c = 0; c < 3; c++)
                for (std::size_t primary = 0; primary < 3; primary++) seen[c][primary] += matching[c] * basis[primary] * d65(wavelength) * step;
        }
        return inverse(seen);
    }();
    return matrix;
}

} // namespace

double d65(double wavelength)
{
    if (!(wavelength >= cie_lambda_min && wavelength <= cie_lambda_max)) return 0.0;
    const std::span<const CieRow> rows = cie_rows();
    const double place = (wavelength - cie_lambda_min) / cie_lambda_step;
    const auto row = std::min(static_cast<std::size_t>(place), rows.size() - 2);
    const double t = place - static_cast<double>(row);
    return (static_cast<double>(rows[row].d65) * (1.0 - t) + static_cast<double>(rows[row + 1].d65) * t) / 100.0;
}

Double3 reflectance_basis(double wavelength)
{
    const double red = interpolate(red_table, wavelength), green = interpolate(green_table, wavelength);
    return {red, green, std::max(0.0, 1.0 - red - green)};
}

Double3 rgb_matching(double wavelength)
{
    const Double3 matching = unscaled_matching(wavelength);
    const Matrix& m = correction();
    return {dot(m[0], matching), dot(m[1], matching), dot(m[2], matching)};
}

} // namespace sundog
