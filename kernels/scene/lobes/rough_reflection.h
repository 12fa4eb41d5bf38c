// Reflection by microfacets: f = F D G1(o) G1(i) / (4 cos_o cos_i) [Cook and Torrance 1982; Walter et al. 2007, eq. 20].
// What is here leaves Fresnel's factor F, a function of the angle to the facet, to the lobe.
// Single scattering: light that meets a second facet is lost (at alpha = 1 about half of it at grazing angles).
#ifndef SUNDOG_LOBE_ROUGH_REFLECTION_H
#define SUNDOG_LOBE_ROUGH_REFLECTION_H
#include "scene/lobes/microfacet.h"

// f / F, and the cosine between the directions and the facet.
static inline float evaluate_rough_reflection(const Scattering* scattering, float3 outgoing, float3 incoming, float* cos_h)
{
    const Frame frame = lobe_frame(scattering);
    const float3 o = to_local(frame, outgoing), i = to_local(frame, incoming);
    *cos_h = 1.0f;
    if (o.z <= 0.0f || i.z <= 0.0f) return 0.0f;
    const Microfacets m = lobe_microfacets(scattering);
    const float3 h = normalize(o + i);
    *cos_h = dot(o, h);
    return microfacet_d(&m, h) * microfacet_g1(&m, o) * microfacet_g1(&m, i) / (4.0f * o.z * i.z);
}

// Density (1/sr) of the incoming direction, and as `reverse` that of the outgoing one for a path that comes from `incoming`.
static inline float rough_reflection_densities(const Scattering* scattering, float3 outgoing, float3 incoming, float* reverse)
{
    const Frame frame = lobe_frame(scattering);
    const float3 o = to_local(frame, outgoing), i = to_local(frame, incoming);
    *reverse = 0.0f;
    if (o.z <= 0.0f || i.z <= 0.0f) return 0.0f;
    const Microfacets m = lobe_microfacets(scattering);
    const float d = 0.25f * microfacet_d(&m, normalize(o + i));
    *reverse = d * microfacet_g1(&m, i) / i.z;
    return d * microfacet_g1(&m, o) / o.z;
}

static inline float rough_reflection_pdf_w(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    float unused;
    return rough_reflection_densities(scattering, outgoing, incoming, &unused);
}

// The weight is that of F = 1.
static inline BsdfSample sample_rough_reflection(const Scattering* scattering, float3 outgoing, float2 u, float* cos_h)
{
    const Frame frame = lobe_frame(scattering);
    const Microfacets m = lobe_microfacets(scattering);
    const float3 o = to_local(frame, outgoing);
    const float3 h = sample_visible_normal(&m, o, u);
    *cos_h = dot(o, h);
    const float3 i = normalize(2.0f * *cos_h * h - o);
    BsdfSample sample;
    sample.direction = to_world(frame, i);
    sample.pdf_w = fmax(microfacet_d(&m, h) * microfacet_g1(&m, o) / (4.0f * o.z), 1e-20f);
    sample.weight = (float3)(i.z > 0.0f ? microfacet_g1(&m, i) : 0.0f);
    sample.eta_scale = 1.0f;
    return sample;
}

#endif
