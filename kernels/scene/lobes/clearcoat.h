// The second reflection of the principled BSDF: f = reflectance F D G, with the long-tailed distribution
// D = (a^2 - 1) / (pi ln a^2 (1 + (a^2 - 1) cos^2 h)), Schlick's F from 0.04, and G of GGX at the roughness 0.25
// [Burley 2012, section 5.4 and appendix B.2: GTR with gamma = 1]. Of the lobe: alpha_u is a (< 1).
#ifndef SUNDOG_LOBE_CLEARCOAT_H
#define SUNDOG_LOBE_CLEARCOAT_H
#include "scene/lobes/microfacet.h"
#include "scene/lobes/schlick.h"

#define CLEARCOAT_F0 0.04f
#define CLEARCOAT_MASKING_ALPHA 0.25f

// Density (1/sr) per projected area. In sin^2 h, whose digits a narrow distribution needs.
static inline float clearcoat_d(float alpha, float3 h)
{
    const float a2 = alpha * alpha;
    return (a2 - 1.0f) / (PI_F * log(a2) * (h.x * h.x + h.y * h.y + a2 * h.z * h.z));
}

// F G for directions in the lobe's frame.
static inline float clearcoat_factor(const Scattering* scattering, float3 o, float3 i, float cos_h)
{
    const Microfacets masking = {CLEARCOAT_MASKING_ALPHA, CLEARCOAT_MASKING_ALPHA, false};
    return mix(CLEARCOAT_F0, 1.0f, schlick_weight(cos_h, scattering->eta)) * microfacet_g1(&masking, o) * microfacet_g1(&masking, i);
}

static inline float3 evaluate_clearcoat(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    const Frame frame = lobe_frame(scattering);
    const float3 o = to_local(frame, outgoing), i = to_local(frame, incoming);
    if (o.z <= 0.0f || i.z <= 0.0f) return (float3)(0.0f);
    const float3 h = normalize(o + i);
    return scattering->reflectance * (clearcoat_d(scattering->alpha_u, h) * clearcoat_factor(scattering, o, i, dot(o, h)));
}

static inline float clearcoat_pdf_w(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    const Frame frame = lobe_frame(scattering);
    const float3 o = to_local(frame, outgoing), i = to_local(frame, incoming);
    if (o.z <= 0.0f || i.z <= 0.0f) return 0.0f;
    const float3 h = normalize(o + i);
    return clearcoat_d(scattering->alpha_u, h) * h.z / (4.0f * dot(o, h));
}

// Facets by D(h) cos h: sin^2 h = (a^(2 - 2u) - a^2) / (1 - a^2).
static inline BsdfSample sample_clearcoat(const Scattering* scattering, float3 outgoing, float2 u)
{
    const Frame frame = lobe_frame(scattering);
    const float3 o = to_local(frame, outgoing);
    const float a2 = scattering->alpha_u * scattering->alpha_u;
    const float sin2 = clamp((pow(a2, 1.0f - u.x) - a2) / (1.0f - a2), 0.0f, 1.0f);
    const float sine = sqrt(sin2), phi = 2.0f * PI_F * u.y;
    const float3 h = (float3)(sine * cos(phi), sine * sin(phi), sqrt(1.0f - sin2));
    const float cos_h = dot(o, h);
    const float3 i = normalize(2.0f * cos_h * h - o);
    BsdfSample sample;
    sample.direction = to_world(frame, i);
    sample.eta_scale = 1.0f;
    sample.pdf_w = fmax(clearcoat_d(scattering->alpha_u, h) * h.z / (4.0f * fmax(cos_h, 1e-6f)), 1e-20f);
    sample.weight = (float3)(0.0f);
    if (cos_h > 0.0f && i.z > 0.0f)
        sample.weight = scattering->reflectance * (clearcoat_factor(scattering, o, i, cos_h) * 4.0f * i.z * cos_h / h.z);
    return sample;
}

#endif
