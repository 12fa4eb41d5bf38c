// Smooth interfaces between dielectrics, and panes without thickness.
#ifndef SUNDOG_LOBE_DIELECTRIC_H
#define SUNDOG_LOBE_DIELECTRIC_H
#include "scene/fresnel.h"
#include "scene/scattering.h"

static inline BsdfSample sample_dielectric(const Scattering* scattering, float3 o, float u, int carries)
{
    const bool entering = scattering->cos_o > 0.0f;
    const float3 n = entering ? scattering->normal : -scattering->normal;
    const float cos_o = fabs(scattering->cos_o);
    const float eta = entering ? scattering->eta : 1.0f / scattering->eta;
    float cos_t;
    const float reflected = fresnel_dielectric(cos_o, eta, &cos_t);
    // Chosen with Fresnel's probability, so it cancels out of the weight.
    if (u < reflected) return specular_sample(reflect(o, n, cos_o), scattering->reflectance);
    BsdfSample sample = specular_sample(refract(o, n, cos_o, cos_t, eta), scattering->transmittance);
    // Radiance is compressed by (eta_i / eta_t)^2 where light goes from the far to the near side; flux is kept.
    if (carries == CARRIES_RADIANCE) sample.weight /= eta * eta;
    sample.eta_scale = eta * eta;
    return sample;
}

// A pane: inter-reflections between its two faces summed up, R' = 2 R / (1 + R); light passes unbent.
static inline BsdfSample sample_thin_dielectric(const Scattering* scattering, float3 o, float u)
{
    const float cos_o = fabs(scattering->cos_o);
    const float3 n = scattering->cos_o > 0.0f ? scattering->normal : -scattering->normal;
    float cos_t;
    const float one_face = fresnel_dielectric(cos_o, scattering->eta, &cos_t);
    const float reflected = one_face < 1.0f ? 2.0f * one_face / (1.0f + one_face) : 1.0f;
    if (u < reflected) return specular_sample(reflect(o, n, cos_o), scattering->reflectance);
    return specular_sample(-o, scattering->transmittance);
}

#endif
