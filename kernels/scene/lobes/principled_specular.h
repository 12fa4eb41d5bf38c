// Reflection by the microfacets of the principled BSDF, metal and dielectric in one: Fresnel's factor is
// eta_rgb F(eta) + F0 + (F90 - F0) w, with Schlick's w and F0 in the lobe's reflectance, F90 in its transmittance
// [Burley 2012, section 5.4 and 5.5].
#ifndef SUNDOG_LOBE_PRINCIPLED_SPECULAR_H
#define SUNDOG_LOBE_PRINCIPLED_SPECULAR_H
#include "scene/fresnel.h"
#include "scene/lobes/rough_reflection.h"
#include "scene/lobes/schlick.h"

static inline float3 principled_fresnel(const Scattering* scattering, float cos_h)
{
    float cos_t;
    const float cosine = fmin(fabs(cos_h), 1.0f);
    const float3 f0 = scattering->reflectance, f90 = scattering->transmittance;
    return scattering->eta_rgb * fresnel_dielectric(cosine, scattering->eta, &cos_t) + f0 +
           (f90 - f0) * schlick_weight(cosine, scattering->eta);
}

static inline float3 evaluate_principled_specular(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    float cos_h;
    const float shape = evaluate_rough_reflection(scattering, outgoing, incoming, &cos_h);
    return principled_fresnel(scattering, cos_h) * shape;
}

static inline BsdfSample sample_principled_specular(const Scattering* scattering, float3 outgoing, float2 u)
{
    float cos_h;
    BsdfSample sample = sample_rough_reflection(scattering, outgoing, u, &cos_h);
    sample.weight *= principled_fresnel(scattering, cos_h);
    return sample;
}

#endif
