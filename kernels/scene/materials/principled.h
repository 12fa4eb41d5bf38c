// Disney's principled BSDF [Burley 2012, Physically Based Shading at Disney; Burley 2015, Extending the Disney BRDF to a
// BSDF with Integrated Subsurface Scattering], in the form that Mitsuba 3 gives it. Seen from outside:
//   (1 - metallic) (1 - spec_trans)  diffuse part, with sheen beside it, and reflection of a dielectric
//   (1 - metallic) spec_trans        rough glass, whose transmission takes on the colour's square root each time
//   metallic                         reflection by Schlick's approximation from the base colour
// and a clear coat on top. From inside, the glass alone. The parts of the two reflections that are not glass's own share
// their microfacets, and are one lobe.
#ifndef SUNDOG_MATERIAL_PRINCIPLED_H
#define SUNDOG_MATERIAL_PRINCIPLED_H
#include "scene/fresnel.h"
#include "scene/lobes/clearcoat.h"
#include "scene/spectral.h"
#include "scene/texture.h"
#include "shared/principled.h"

#define PRINCIPLED_MIN_ALPHA 1e-3f
#define CLEARCOAT_DULL_ALPHA 0.1f
#define CLEARCOAT_GLOSSY_ALPHA 1e-3f

// What the lobes are weighted by at a surface, in transport's colours.
typedef struct PrincipledParts {
    float3 diffuse; // base colour of the diffuse part
    float3 sheen;
    float3 f0, f90;   // of metal and of tinted dielectric reflection
    float dielectric; // of untinted dielectric reflection beside glass
    float3 transmitted;
    float3 glass; // reflected by the glass
    float clearcoat;
} PrincipledParts;

static inline float principled_number(const SurfaceView* scene, TexturedNumber number, const Surface* surface)
{
    return clamp(textured_number(scene, number, surface), 0.0f, 1.0f);
}

static inline PrincipledParts principled_parts(const SurfaceView* scene, const Principled* p, const Bsdf* bsdf, const Surface* surface,
                                               bool outside)
{
    const float3 color = fmax(textured_color(scene, p->base_color, surface), (float3)(0.0f));
    const float luminance = dot(color, LUMINANCE_WEIGHTS);
    const float3 hue = luminance > 0.0f ? color / luminance : (float3)(1.0f);
    const float nonmetal = 1.0f - principled_number(scene, p->metallic, surface);
    const float spec_trans = LOBE_OCCURS(LOBE_ROUGH_DIELECTRIC) ? principled_number(scene, p->spec_trans, surface) : 0.0f;
    PrincipledParts parts;
    parts.transmitted = transport_reflectance(scene, sqrt(color)) * (nonmetal * spec_trans);
    parts.glass = (float3)(nonmetal * spec_trans);
    parts.diffuse = parts.sheen = parts.f0 = parts.f90 = (float3)(0.0f);
    parts.dielectric = parts.clearcoat = 0.0f;
    if (!outside) return parts;
    const float sheen_tint = principled_number(scene, p->sheen_tint, surface);
    parts.diffuse = transport_reflectance(scene, color) * (nonmetal * (1.0f - spec_trans));
    parts.sheen =
        transport_reflectance(scene, mix((float3)(1.0f), hue, sheen_tint)) * (nonmetal * principled_number(scene, p->sheen, surface));
    if (LOBE_OCCURS(LOBE_CLEARCOAT)) parts.clearcoat = principled_number(scene, p->clearcoat, surface);
    // Without an interface there is nothing that reflects: in Mitsuba not even metal.
    if (bsdf->eta == 1.0f) return parts;
    const float spec_tint = principled_number(scene, p->spec_tint, surface);
    const float r0 = squared((bsdf->eta - 1.0f) / (bsdf->eta + 1.0f));
    const float metal = 1.0f - nonmetal;
    parts.glass *= 1.0f - spec_tint;
    parts.dielectric = nonmetal * (1.0f - spec_trans) * (1.0f - spec_tint);
    parts.f0 = transport_reflectance(scene, color * metal + hue * (nonmetal * spec_tint * r0));
    parts.f90 = (float3)(metal + nonmetal * spec_tint);
    return parts;
}

static inline float mean_of_three(float3 v)
{
    return (v.x + v.y + v.z) * (1.0f / 3.0f);
}

// About how much light each lobe sends on: LOBE_PRINCIPLED_DIFFUSE, LOBE_PRINCIPLED_SPECULAR, LOBE_CLEARCOAT, glass. A
// function of what is known wherever a lobe is asked for, the outgoing direction and the surface; positive where the
// lobe is.
static inline float4 principled_weights(const PrincipledParts* parts, float eta, float cos_o)
{
    float cos_t;
    const float cosine = fmin(fabs(cos_o), 1.0f);
    const float reflected = fresnel_dielectric(cosine, cos_o > 0.0f ? eta : 1.0f / eta, &cos_t);
    const float schlick = schlick_weight(cosine, eta);
    const float sheen_share = 0.01f + 0.3f * squared(1.0f - cosine); // grows towards the horizon, as sheen does
    return (float4)(mean_of_three(parts->diffuse) + mean_of_three(parts->sheen) * sheen_share,
                    parts->dielectric * reflected + mean_of_three(parts->f0 + (parts->f90 - parts->f0) * schlick),
                    parts->clearcoat * mix(CLEARCOAT_F0, 1.0f, schlick) * cosine,
                    mean_of_three(parts->glass) * reflected + mean_of_three(parts->transmitted) * (1.0f - reflected));
}

static inline void choose_principled_lobe(const SurfaceView* scene, const Bsdf* bsdf, const Surface* surface, float u,
                                          Scattering* scattering)
{
    const Principled p = scene->principled[bsdf->nested[0]];
    const PrincipledParts parts = principled_parts(scene, &p, bsdf, surface, scattering->cos_o > 0.0f);
    const float4 weights = principled_weights(&parts, bsdf->eta, scattering->cos_o);
    const float weight[4] = {weights.x, weights.y, weights.z, weights.w};
    const float total = weight[0] + weight[1] + weight[2] + weight[3];
    float rest = u * total;
    uint chosen = 0u;
    for (uint i = 0u; i < 4u; ++i) { // the last one of some weight that begins before u
        if (weight[i] > 0.0f && rest >= 0.0f) chosen = i;
        rest -= weight[i];
    }
    const float scale = weight[chosen] > 0.0f ? total / weight[chosen] : 0.0f;
    const float roughness = principled_number(scene, p.roughness, surface);
    const float aspect = sqrt(1.0f - 0.9f * principled_number(scene, p.anisotropic, surface)); // [Burley 2012, addenda]
    scattering->alpha_u = fmax(roughness * roughness / aspect, PRINCIPLED_MIN_ALPHA);
    scattering->alpha_v = fmax(roughness * roughness * aspect, PRINCIPLED_MIN_ALPHA);
    if (chosen == 0u) {
        scattering->lobe = LOBE_PRINCIPLED_DIFFUSE;
        scattering->reflectance = parts.diffuse * scale;
        scattering->transmittance = parts.sheen * scale;
        scattering->alpha_u = roughness;
        scattering->alpha_v = principled_number(scene, p.flatness, surface);
    } else if (chosen == 1u) {
        scattering->lobe = LOBE_PRINCIPLED_SPECULAR;
        scattering->reflectance = parts.f0 * scale;
        scattering->transmittance = parts.f90 * scale;
        scattering->eta_rgb = (float3)(parts.dielectric * scale);
    } else if (chosen == 2u) {
        scattering->lobe = LOBE_CLEARCOAT;
        scattering->reflectance = (float3)(0.25f * parts.clearcoat * scale);
        scattering->alpha_u = mix(CLEARCOAT_DULL_ALPHA, CLEARCOAT_GLOSSY_ALPHA, principled_number(scene, p.clearcoat_gloss, surface));
        scattering->alpha_v = scattering->alpha_u;
    } else {
        scattering->lobe = LOBE_ROUGH_DIELECTRIC;
        scattering->reflectance = parts.glass * scale;
        scattering->transmittance = parts.transmitted * scale;
    }
}

#endif
