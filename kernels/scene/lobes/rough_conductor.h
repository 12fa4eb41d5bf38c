// Rough metal: reflection by microfacets of a complex index.
#ifndef SUNDOG_LOBE_ROUGH_CONDUCTOR_H
#define SUNDOG_LOBE_ROUGH_CONDUCTOR_H
#include "scene/fresnel.h"
#include "scene/lobes/rough_reflection.h"

static inline float3 rough_conductor_fresnel(const Scattering* scattering, float cos_h)
{
    return scattering->reflectance * fresnel_conductor(cos_h, scattering->eta_rgb, scattering->k_rgb);
}

static inline float3 evaluate_rough_conductor(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    float cos_h;
    const float shape = evaluate_rough_reflection(scattering, outgoing, incoming, &cos_h);
    return rough_conductor_fresnel(scattering, cos_h) * shape;
}

static inline BsdfSample sample_rough_conductor(const Scattering* scattering, float3 outgoing, float2 u)
{
    float cos_h;
    BsdfSample sample = sample_rough_reflection(scattering, outgoing, u, &cos_h);
    sample.weight *= rough_conductor_fresnel(scattering, cos_h);
    return sample;
}

#endif
