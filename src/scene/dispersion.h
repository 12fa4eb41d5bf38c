// Indices of refraction that depend on the wavelength.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sundog {

// Sellmeier's formula for the index against vacuum or air, n^2 = 1 + sum of b l^2 / (l^2 - c) with l in micrometres.
struct SellmeierFormula {
    double b[4];
    double c[4]; // square micrometres
};

// Wavelength (micrometres) of the sodium D line, at which indices are given where only one is asked for.
inline constexpr double sodium_d_line = 0.5893;

double index_at(const SellmeierFormula& formula, double micrometres);

// By the name of a material (case does not matter). Nothing for an unknown name.
std::optional<SellmeierFormula> find_dispersion(std::string_view name);

// The material that has this formula. Nothing for a formula that is no material's.
std::optional<std::string> name_of(const SellmeierFormula& formula);

// All names, separated by ", ", for messages.
std::string dispersion_names();

} // namespace sundog
