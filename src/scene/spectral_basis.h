// Spectra that stand for linear sRGB colours, and back. Sums over wavelengths weigh by D65, so that white is (1, 1, 1).
#pragma once

#include "math/double3.h"

namespace sundog {

// The tables' nodes, every `spectral_step` nm; spectra are linear between them and end there.
inline constexpr int spectral_nodes = 48;
inline constexpr double shortest_wavelength = 360.0; // nm
inline constexpr double longest_wavelength = 830.0;
inline constexpr double spectral_step = 10.0;

// Made by scripts/make_spectral_basis.
extern const double red_table[spectral_nodes];
extern const double green_table[spectral_nodes];

// Relative power of CIE standard illuminant D65 at a wavelength (nm), 1 at 560 nm; 0 outside of scene/cie_tables.h.
double d65(double wavelength);

// Reflectances at a wavelength (nm, within the tables) of the colours (1, 0, 0), (0, 1, 0) and (0, 0, 1): smooth, between
// 0 and 1, and 1 in sum [Mallett and Yuksel 2019]. Others are mixtures: rho(lambda) = rgb . basis(lambda).
Double3 reflectance_basis(double wavelength);

// How linear sRGB responds to power at a wavelength, 1/nm: rgb = integral of L(lambda) rgb_matching(lambda). From the CIE
// 1931 curves of scene/spectrum.h, with the rounding of matrix and basis taken out: the basis under D65, as above, has
// (1, 0, 0), (0, 1, 0) and (0, 0, 1).
Double3 rgb_matching(double wavelength);

} // namespace sundog
