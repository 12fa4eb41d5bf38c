// Spectra reduced to linear sRGB, the colour that the renderer computes with.
#pragma once

#include "math/vec3.h"

#include <span>

namespace sundog
{

struct SpectrumSample {
    double wavelength; // nm
    double value;
};

// The CIE 1931 2-degree colour matching functions (x, y, z) at a wavelength in nm; 0 outside of 360 to 830 nm.
Vec3 cie_1931(double wavelength);

// Linear sRGB (Rec. 709 primaries, D65 white) of CIE XYZ.
Vec3 linear_srgb_from_xyz(double x, double y, double z);

// A spectral reflectance or transmittance, linear between samples and 0 outside of them, seen under the illuminant
// D65, as in Mitsuba 3: 1 at all wavelengths becomes (1, 1, 1).
// Clamped to [0, 1]. Samples in increasing order of wavelength, at least two.
Vec3 reflectance_to_rgb(std::span<const SpectrumSample> samples);

// The same without the clamp at 1: for indices of refraction.
Vec3 index_to_rgb(std::span<const SpectrumSample> samples);

// A spectral radiance (or intensity, or irradiance) per nm, in Mitsuba's normalisation: 1 at all wavelengths
// has the luminance 1. Out-of-gamut negatives are clamped to 0.
Vec3 emission_to_rgb(std::span<const SpectrumSample> samples);

// Radiance of a black body (kelvin > 0) by Planck's law in W/m^2/sr/nm, reduced as by emission_to_rgb.
Vec3 blackbody_to_rgb(double kelvin);

} // namespace sundog
