// A lobe below a smooth dielectric layer [Weidlich and Wilkie 2007, Arbitrarily Layered Micro-Facet Surfaces]:
//     f(o, i) = f'(o', i') T(o) T(i) exp(-d (1 / cos o' + 1 / cos i')) / eta^2
// for the lobe's own f', with both directions refracted into the layer. Light that the layer turns back from within is lost.
// Of the lobe: eta is the layer's index over that outside, transmittance its optical depth d, along the normal.
#ifndef SUNDOG_LOBE_COAT_H
#define SUNDOG_LOBE_COAT_H
#include "scene/fresnel.h"
#include "scene/scattering.h"

// One crossing of the layer's surface.
typedef struct CoatCrossing {
    float3 below; // the direction within, away from the base; unit
    float cosine; // outside, to the normal
    float cosine_below;
    float passed; // what is not reflected: from outside as from within
} CoatCrossing;

// False: the direction is not above the surface, or all light is reflected.
static inline bool cross_coat(const Scattering* scattering, float3 direction, CoatCrossing* crossing)
{
    crossing->cosine = fmin(dot(direction, scattering->normal), 1.0f);
    if (crossing->cosine <= 0.0f) return false;
    crossing->passed = 1.0f - fresnel_dielectric(crossing->cosine, scattering->eta, &crossing->cosine_below);
    crossing->below = normalize((direction - scattering->normal * crossing->cosine) / scattering->eta + scattering->normal * crossing->cosine_below);
    return crossing->passed > 0.0f && crossing->cosine_below > 0.0f;
}

// The same from within. False also where all light is turned back.
static inline bool leave_coat(const Scattering* scattering, float3 below, CoatCrossing* crossing)
{
    const float cosine_below = dot(below, scattering->normal);
    const float sin2 = scattering->eta * scattering->eta * fmax(1.0f - cosine_below * cosine_below, 0.0f);
    if (cosine_below <= 0.0f || sin2 >= 1.0f) return false;
    return cross_coat(scattering, normalize((below - scattering->normal * cosine_below) * scattering->eta + scattering->normal * sqrt(1.0f - sin2)), crossing);
}

// What is left of light that crosses the layer both ways.
static inline float3 coat_passage(const Scattering* scattering, const CoatCrossing* out, const CoatCrossing* in)
{
    return exp(-scattering->transmittance * (1.0f / out->cosine_below + 1.0f / in->cosine_below)) * (out->passed * in->passed);
}

// Solid angle within over solid angle outside, times the cosines: eta^2 cos i' dw' = cos i dw.
static inline float coat_compression(const Scattering* scattering, const CoatCrossing* crossing)
{
    return crossing->cosine / (scattering->eta * scattering->eta * crossing->cosine_below);
}

// The lobe without the layer, as it is met there.
static inline Scattering below_coat(const Scattering* scattering, const CoatCrossing* out)
{
    Scattering below = *scattering;
    below.flags &= ~LOBE_COATED;
    below.cos_o = out->cosine_below;
    return below;
}

#endif
