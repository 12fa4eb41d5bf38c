// Ground glass [Walter et al. 2007]: microfacets that reflect and refract, eq. 20 and 21.
#ifndef SUNDOG_LOBE_ROUGH_DIELECTRIC_H
#define SUNDOG_LOBE_ROUGH_DIELECTRIC_H
#include "scene/fresnel.h"
#include "scene/lobes/microfacet.h"

// The interface as seen from the outgoing direction: everything mirrored so that o.z > 0.
typedef struct RoughInterface {
    Frame frame;
    Microfacets facets;
    float3 o;
    float eta; // far over near
} RoughInterface;

static inline RoughInterface rough_interface(const Scattering* scattering, float3 outgoing)
{
    RoughInterface face;
    face.frame = lobe_frame(scattering);
    face.facets = lobe_microfacets(scattering);
    face.eta = scattering->eta;
    if (scattering->cos_o < 0.0f) {
        face.frame.n = -face.frame.n;
        face.frame.t = -face.frame.t;
        face.eta = 1.0f / scattering->eta;
    }
    face.o = to_local(face.frame, outgoing);
    return face;
}

// Normal of the facets that send light from i to o: the half vector of reflection or refraction, on o's side.
static inline float3 interface_half_vector(const RoughInterface* face, float3 i)
{
    const float3 h = normalize(i.z > 0.0f ? face->o + i : face->o + i * face->eta);
    return h.z < 0.0f ? -h : h;
}

// Jacobian of h to i for refraction, eq. 17: eta^2 |i.h| / (o.h + eta i.h)^2.
static inline float refraction_jacobian(const RoughInterface* face, float cos_oh, float cos_ih)
{
    return face->eta * face->eta * fabs(cos_ih) / fmax(squared(cos_oh + face->eta * cos_ih), 1e-12f);
}

static inline float3 evaluate_rough_dielectric(const Scattering* scattering, float3 outgoing, float3 incoming, int carries)
{
    const RoughInterface face = rough_interface(scattering, outgoing);
    const float3 i = to_local(face.frame, incoming);
    if (face.o.z <= 0.0f || i.z == 0.0f) return (float3)(0.0f);
    const float3 h = interface_half_vector(&face, i);
    const float cos_oh = dot(face.o, h), cos_ih = dot(i, h);
    if (cos_oh <= 0.0f || cos_ih * i.z <= 0.0f) return (float3)(0.0f); // facets seen from behind
    float cos_t;
    const float fresnel = fresnel_dielectric(cos_oh, face.eta, &cos_t);
    const float3 i_up = (float3)(i.xy, fabs(i.z));
    const float shape = microfacet_d(&face.facets, h) * microfacet_g1(&face.facets, face.o) * microfacet_g1(&face.facets, i_up);
    if (i.z > 0.0f) return scattering->reflectance * (fresnel * shape / (4.0f * face.o.z * i.z));
    const float refracted = (1.0f - fresnel) * shape * cos_oh * refraction_jacobian(&face, cos_oh, cos_ih) / (face.o.z * fabs(i.z));
    return scattering->transmittance * (carries == CARRIES_RADIANCE ? refracted / (face.eta * face.eta) : refracted);
}

static inline float rough_dielectric_pdf_w(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    const RoughInterface face = rough_interface(scattering, outgoing);
    const float3 i = to_local(face.frame, incoming);
    if (face.o.z <= 0.0f || i.z == 0.0f) return 0.0f;
    const float3 h = interface_half_vector(&face, i);
    const float cos_oh = dot(face.o, h), cos_ih = dot(i, h);
    if (cos_oh <= 0.0f || cos_ih * i.z <= 0.0f) return 0.0f;
    float cos_t;
    const float fresnel = fresnel_dielectric(cos_oh, face.eta, &cos_t);
    const float normal_pdf = visible_normal_pdf(&face.facets, face.o, h);
    return i.z > 0.0f ? fresnel * normal_pdf / (4.0f * cos_oh) : (1.0f - fresnel) * normal_pdf * refraction_jacobian(&face, cos_oh, cos_ih);
}

// Facet by visible normals, side by Fresnel's probability.
static inline BsdfSample sample_rough_dielectric(const Scattering* scattering, float3 outgoing, float3 u, int carries)
{
    const RoughInterface face = rough_interface(scattering, outgoing);
    const float3 h = sample_visible_normal(&face.facets, face.o, u.xy);
    const float cos_oh = fmax(dot(face.o, h), 0.0f);
    float cos_t;
    const float fresnel = fresnel_dielectric(cos_oh, face.eta, &cos_t);
    const float normal_pdf = visible_normal_pdf(&face.facets, face.o, h);
    BsdfSample sample;
    sample.weight = (float3)(0.0f);
    float3 i;
    if (u.z < fresnel) {
        i = reflect(face.o, h, cos_oh);
        sample.pdf_w = fresnel * normal_pdf / (4.0f * cos_oh);
        sample.eta_scale = 1.0f;
        if (i.z > 0.0f) sample.weight = scattering->reflectance * microfacet_g1(&face.facets, i);
    } else {
        i = refract(face.o, h, cos_oh, cos_t, face.eta);
        sample.pdf_w = (1.0f - fresnel) * normal_pdf * refraction_jacobian(&face, cos_oh, dot(i, h));
        sample.eta_scale = face.eta * face.eta;
        const float scale = carries == CARRIES_RADIANCE ? 1.0f / sample.eta_scale : 1.0f;
        if (i.z < 0.0f) sample.weight = scattering->transmittance * (scale * microfacet_g1(&face.facets, (float3)(i.xy, -i.z)));
    }
    sample.pdf_w = fmax(sample.pdf_w, 1e-20f);
    sample.direction = to_world(face.frame, i);
    return sample;
}

#endif
