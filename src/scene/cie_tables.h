// What the CIE tabulates: the 1931 2-degree colour matching functions and the illuminant D65 (CIE 15, tables T.4
// and T.1), which is scaled to 100 at 560 nm.
#pragma once

#include <span>

namespace sundog
{

struct CieRow {
    float x, y, z;
    float d65;
};

constexpr double cie_lambda_min = 360.0; // nm
constexpr double cie_lambda_max = 830.0;
constexpr double cie_lambda_step = 5.0;

// From cie_lambda_min to cie_lambda_max; linear in between.
std::span<const CieRow> cie_rows();

} // namespace sundog
