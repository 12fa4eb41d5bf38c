// Which wavelengths a pass of spectral transport computes with [Wilkie et al. 2014, Hero Wavelength Spectral Sampling].
#pragma once

#include "shared/wavelengths.h"

#include <array>
#include <cstdint>

namespace sundog {

inline constexpr int wavelengths_of_a_pass = 3;

// Probability density of a wavelength (1/nm), in proportion to what D65 adds to the CIE's x, y and z together: constant
// within each nanometre, 0 outside of [360, 830] nm.
double wavelength_density(double wavelength);

// The wavelength (nm) below which lies this share, in [0, 1], of the density.
double wavelength_at(double share);

// Wavelengths of a pass in nm, ascending: shares (u + k) / 3 of the density, where u steps through [0, 1) by the golden
// ratio from pass to pass, beginning where the seed says. Each is uniform in its third, so all three together have
// wavelength_density, and so has any one chosen with probability 1/3. A pure function of seed and pass.
std::array<double, wavelengths_of_a_pass> pass_wavelengths(std::uint64_t seed, std::uint64_t pass);

// The matrices for given wavelengths (nm), each of which has the density above over the passes and choices of k. Turns are 0.
Wavelengths make_wavelengths(const std::array<double, wavelengths_of_a_pass>& wavelengths);

} // namespace sundog
