// Diffuse part of the principled BSDF [Burley 2012, section 5.3; 2015, sections 2 and 4.4]: Burley's diffuse model with its
// retro-reflection, blended with his approximation of subsurface scattering by `flatness`, and sheen.
// Of the lobe: reflectance is the base colour and transmittance the colour of the sheen, both weighted; alpha_u is the
// roughness and alpha_v the flatness.
#ifndef SUNDOG_LOBE_PRINCIPLED_DIFFUSE_H
#define SUNDOG_LOBE_PRINCIPLED_DIFFUSE_H
#include "scene/lobes/diffuse.h"
#include "scene/lobes/schlick.h"

static inline float3 evaluate_principled_diffuse(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    const float cos_o = scattering->cos_o, cos_i = dot(incoming, scattering->normal);
    const float cos2_h = clamp(0.5f + 0.5f * dot(outgoing, incoming), 0.0f, 1.0f); // of the half vector to either
    const float w_o = fifth_power_of_rest(cos_o), w_i = fifth_power_of_rest(cos_i);
    const float retro = 2.0f * scattering->alpha_u * cos2_h;
    const float diffuse = (1.0f - 0.5f * w_o) * (1.0f - 0.5f * w_i) + retro * (w_o + w_i + w_o * w_i * (retro - 1.0f));
    const float fss90 = 0.5f * retro;
    const float fss = mix(1.0f, fss90, w_o) * mix(1.0f, fss90, w_i);
    const float subsurface = 1.25f * (fss * (1.0f / fmax(cos_o + cos_i, 1e-6f) - 0.5f) + 0.5f);
    const float shape = mix(diffuse, subsurface, scattering->alpha_v);
    return scattering->reflectance * (shape * INV_PI_F) + scattering->transmittance * fifth_power_of_rest(sqrt(cos2_h));
}

static inline BsdfSample sample_principled_diffuse(const Scattering* scattering, float3 outgoing, float2 u)
{
    BsdfSample sample = sample_diffuse(scattering, u);
    sample.weight = evaluate_principled_diffuse(scattering, outgoing, sample.direction) * PI_F;
    return sample;
}

#endif
