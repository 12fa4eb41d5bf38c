// Rough metal: f = F D G1(o) G1(i) / (4 cos_o cos_i) [Cook and Torrance 1982; Walter et al. 2007, eq. 20].
// Single scattering: light that meets a second facet is lost (at alpha = 1 about half of it at grazing angles).
#ifndef SUNDOG_LOBE_ROUGH_CONDUCTOR_H
#define SUNDOG_LOBE_ROUGH_CONDUCTOR_H
#include "scene/fresnel.h"
#include "scene/lobes/microfacet.h"

static inline float3 evaluate_rough_conductor(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    const Frame frame = lobe_frame(scattering);
    const float3 o = to_local(frame, outgoing), i = to_local(frame, incoming);
    if (o.z <= 0.0f || i.z <= 0.0f) return (float3)(0.0f);
    const Microfacets m = lobe_microfacets(scattering);
    const float3 h = normalize(o + i);
    const float shape = microfacet_d(&m, h) * microfacet_g1(&m, o) * microfacet_g1(&m, i) / (4.0f * o.z * i.z);
    return scattering->reflectance * fresnel_conductor(dot(o, h), scattering->eta_rgb, scattering->k_rgb) * shape;
}

static inline float rough_conductor_pdf_w(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    const Frame frame = lobe_frame(scattering);
    const float3 o = to_local(frame, outgoing), i = to_local(frame, incoming);
    if (o.z <= 0.0f || i.z <= 0.0f) return 0.0f;
    const Microfacets m = lobe_microfacets(scattering);
    const float3 h = normalize(o + i);
    return microfacet_d(&m, h) * microfacet_g1(&m, o) / (4.0f * o.z);
}

static inline BsdfSample sample_rough_conductor(const Scattering* scattering, float3 outgoing, float2 u)
{
    const Frame frame = lobe_frame(scattering);
    const Microfacets m = lobe_microfacets(scattering);
    const float3 o = to_local(frame, outgoing);
    const float3 h = sample_visible_normal(&m, o, u);
    const float cos_h = dot(o, h);
    const float3 i = normalize(2.0f * cos_h * h - o);
    BsdfSample sample;
    sample.direction = to_world(frame, i);
    sample.pdf_w = fmax(microfacet_d(&m, h) * microfacet_g1(&m, o) / (4.0f * o.z), 1e-20f);
    sample.weight = (float3)(0.0f);
    if (i.z > 0.0f) sample.weight = scattering->reflectance * fresnel_conductor(cos_h, scattering->eta_rgb, scattering->k_rgb) * microfacet_g1(&m, i);
    sample.eta_scale = 1.0f;
    return sample;
}

#endif
