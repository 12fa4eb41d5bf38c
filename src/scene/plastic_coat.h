// What the dielectric coat of plastic lets through.
#pragma once

#include "shared/bsdf.h"

#include <array>

namespace sundog
{

struct CoatTransmission {
    // From outside to the base, by the cosine c to the normal: a Chebyshev series in 2 sqrt(c) - 1 (right to 0.002 c^-1).
    std::array<float, COAT_COEFFICIENTS> series{};
    // Of diffuse light from within, the part that is sent back; of a rough coat 1.5 % less, as in Mitsuba.
    float internal_reflectance = 0.0f;
};

// eta: index within over index outside.
float smooth_internal_reflectance(double eta);

// Single scattering by microfacets of this roughness (> 0) with the masking of both directions, by quadrature
// [Walter et al. 2007, eq. 20 and 21].
CoatTransmission rough_coat(double eta, double alpha, bool beckmann);

} // namespace sundog
