// Smooth metal.
#ifndef SUNDOG_LOBE_CONDUCTOR_H
#define SUNDOG_LOBE_CONDUCTOR_H
#include "scene/fresnel.h"
#include "scene/scattering.h"

static inline BsdfSample sample_conductor(const Scattering* scattering, float3 o)
{
    const float3 fresnel = fresnel_conductor(scattering->cos_o, scattering->eta_rgb, scattering->k_rgb);
    return specular_sample(reflect(o, scattering->normal, scattering->cos_o), fresnel * scattering->reflectance);
}

#endif
