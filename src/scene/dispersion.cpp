#include "scene/dispersion.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace sundog {

namespace {

struct NamedFormula {
    const char* name;
    SellmeierFormula formula;
};

constexpr NamedFormula formulas[] = {
    // Glasses: [Schott 2017, Optical Glass data sheets], N-BK7 and N-SF11.
    {"bk7", {{1.03961212, 0.231792344, 1.01046945, 0}, {0.00600069867, 0.0200179144, 103.560653, 0}}},
    {"sf11", {{1.73759695, 0.313747346, 1.89878101, 0}, {0.013188707, 0.0623068142, 155.23629, 0}}},
    // [Malitson 1965, JOSA 55(10)]
    {"fused silica", {{0.6961663, 0.4079426, 0.8974794, 0}, {0.0684043 * 0.0684043, 0.1162414 * 0.1162414, 9.896161 * 9.896161, 0}}},
    // The ordinary ray; birefringence is left out. [Malitson and Dodge 1972, JOSA 62]
    {"sapphire", {{1.4313493, 0.65054713, 5.3414021, 0}, {0.0726631 * 0.0726631, 0.1193242 * 0.1193242, 18.028251 * 18.028251, 0}}},
    // [Peter 1923, Zeitschrift fuer Physik 15]
    {"diamond", {{0.3306, 4.3356, 0, 0}, {0.1750 * 0.1750, 0.1060 * 0.1060, 0, 0}}},
    // At 20 degrees Celsius. [Daimon and Masumura 2007, Applied Optics 46(18)]
    {"water", {{5.684027565e-1, 1.726177391e-1, 2.086189578e-2, 1.130748688e-1}, {5.101829712e-3, 1.821153936e-2, 2.620722293e-2, 1.069792721e1}}},
};

} // namespace

double index_at(const SellmeierFormula& formula, double micrometres)
{
    const double l2 = micrometres * micrometres;
    double squared = 1.0;
    for (int i = 0; i < 4; i++) squared += formula.b[i] * l2 / (l2 - formula.c[i]);
    return std::sqrt(squared);
}

std::optional<SellmeierFormula> find_dispersion(std::string_view name)
{
    std::string lower(name);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const auto& entry : formulas)
        if (lower == entry.name) return entry.formula;
    return {};
}

std::optional<std::string> name_of(const SellmeierFormula& formula)
{
    for (const auto& entry : formulas)
        if (std::equal(formula.b, formula.b + 4, entry.formula.b) && std::equal(formula.c, formula.c + 4, entry.formula.c)) return entry.name;
    return {};
}

std::string dispersion_names()
{
    std::string names;
    for (const auto& entry : formulas) names += (names.empty() ? "" : ", ") + std::string(entry.name);
    return names;
}

} // namespace sundog
