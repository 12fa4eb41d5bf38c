// Scattering at a surface: sample, evaluate, density; for camera and light subpaths alike.
#ifndef SUNDOG_SCENE_BSDF_H
#define SUNDOG_SCENE_BSDF_H
#include "scene/lobes/clearcoat.h"
#include "scene/lobes/coat.h"
#include "scene/lobes/coated_diffuse.h"
#include "scene/lobes/conductor.h"
#include "scene/lobes/dielectric.h"
#include "scene/lobes/diffuse.h"
#include "scene/lobes/phong.h"
#include "scene/lobes/principled_diffuse.h"
#include "scene/lobes/principled_specular.h"
#include "scene/lobes/rough_conductor.h"
#include "scene/lobes/rough_dielectric.h"
#include "scene/material.h"

static inline bool is_specular(const Scattering* scattering)
{
    switch (scattering->lobe) {
    case LOBE_DIELECTRIC:
    case LOBE_THIN_DIELECTRIC:
    case LOBE_CONDUCTOR:
    case LOBE_NULL: return true;
    default: return false;
    }
}

#define LOBES_MAY_BE_NARROW                                                                                                                \
    (LOBE_OCCURS(LOBE_ROUGH_CONDUCTOR) || LOBE_OCCURS(LOBE_ROUGH_DIELECTRIC) || LOBE_OCCURS(LOBE_PRINCIPLED_SPECULAR) ||                   \
     LOBE_OCCURS(LOBE_CLEARCOAT) || LOBE_OCCURS(LOBE_PHONG))

// Smooth, but too narrow a lobe to look for photons with (and never true of a diffuse one).
static inline bool is_narrow(const Scattering* scattering)
{
    if (!LOBES_MAY_BE_NARROW) return false;
    switch (scattering->lobe) {
    case LOBE_CLEARCOAT:
    case LOBE_ROUGH_DIELECTRIC: return true;
    case LOBE_PRINCIPLED_SPECULAR:
    case LOBE_ROUGH_CONDUCTOR: return fmin(scattering->alpha_u, scattering->alpha_v) < NARROW_ALPHA;
    case LOBE_PHONG: return scattering->alpha_u > NARROW_EXPONENT;
    default: return false;
    }
}

static inline bool is_transmissive(const Scattering* scattering)
{
    switch (scattering->lobe) {
    case LOBE_DIELECTRIC:
    case LOBE_THIN_DIELECTRIC:
    case LOBE_ROUGH_DIELECTRIC:
    case LOBE_NULL: return true;
    default: return false;
    }
}

// Light that neither arrives nor leaves: the black back of an opaque one-sided surface.
static inline bool is_black_side(const Scattering* scattering) { return scattering->cos_o <= 0.0f && !is_transmissive(scattering); }

// An interpolated normal can send a reflection through the face, or a refraction back. Whether a direction is on
// the outgoing one's side of the face and of the shading normal alike.
static inline bool sides_agree(const Scattering* scattering, const Surface* surface, float3 direction)
{
    const bool shading_crosses = dot(direction, scattering->normal) * scattering->cos_o < 0.0f;
    const bool geometry_crosses = dot(direction, surface->geometric_normal) * dot(surface->outgoing, surface->geometric_normal) < 0.0f;
    return shading_crosses == geometry_crosses;
}

// For directions above the surface: of opaque lobes.
static inline float3 evaluate_opaque_lobe(const Scattering* scattering, float3 outgoing, float3 incoming, float cos_i)
{
    switch (scattering->lobe) {
    case LOBE_DIFFUSE: return evaluate_diffuse(scattering);
#if LOBE_OCCURS(LOBE_COATED_DIFFUSE)
    case LOBE_COATED_DIFFUSE: return evaluate_coated_diffuse(scattering, cos_i);
#endif
#if LOBE_OCCURS(LOBE_ROUGH_CONDUCTOR)
    case LOBE_ROUGH_CONDUCTOR: return evaluate_rough_conductor(scattering, outgoing, incoming);
#endif
#if LOBE_OCCURS(LOBE_PRINCIPLED_DIFFUSE)
    case LOBE_PRINCIPLED_DIFFUSE: return evaluate_principled_diffuse(scattering, outgoing, incoming);
#endif
#if LOBE_OCCURS(LOBE_PRINCIPLED_SPECULAR)
    case LOBE_PRINCIPLED_SPECULAR: return evaluate_principled_specular(scattering, outgoing, incoming);
#endif
#if LOBE_OCCURS(LOBE_CLEARCOAT)
    case LOBE_CLEARCOAT: return evaluate_clearcoat(scattering, outgoing, incoming);
#endif
#if LOBE_OCCURS(LOBE_PHONG)
    case LOBE_PHONG: return evaluate_phong(scattering, outgoing, incoming);
#endif
    default: return (float3)(0.0f);
    }
}

#if HAS_COATS
static inline float3 evaluate_coated(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    CoatCrossing out, in;
    if (!cross_coat(scattering, outgoing, &out) || !cross_coat(scattering, incoming, &in)) return (float3)(0.0f);
    const Scattering below = below_coat(scattering, &out);
    const float3 f = evaluate_opaque_lobe(&below, out.below, in.below, in.cosine_below);
    return f * coat_passage(scattering, &out, &in) / (scattering->eta * scattering->eta);
}
#endif

// bsdf_evaluate without the shadows of relief.
static inline float3 evaluate_lobe(const Scattering* scattering, const Surface* surface, float3 incoming, int carries)
{
    const float cos_i = dot(incoming, scattering->normal);
    if (!sides_agree(scattering, surface, incoming) || is_black_side(scattering)) return (float3)(0.0f);
#if LOBE_OCCURS(LOBE_ROUGH_DIELECTRIC)
    if (scattering->lobe == LOBE_ROUGH_DIELECTRIC) return evaluate_rough_dielectric(scattering, surface->outgoing, incoming, carries);
#endif
    if (cos_i <= 0.0f) return (float3)(0.0f);
#if HAS_COATS
    if (scattering->flags & LOBE_COATED) return evaluate_coated(scattering, surface->outgoing, incoming);
#endif
    return evaluate_opaque_lobe(scattering, surface->outgoing, incoming, cos_i);
}

// f (1/sr), without the cosine, from `incoming` (unit) to the outgoing direction; light comes from `incoming` where
// the subpath carries radiance, and from the outgoing direction where it carries flux. Zero for specular lobes.
static inline float3 bsdf_evaluate(const Scattering* scattering, const Surface* surface, float3 incoming, int carries)
{
    const float3 f = evaluate_lobe(scattering, surface, incoming, carries);
#if HAS_RELIEF
    if (scattering->flags & BSDF_SHADOWS_RELIEF) return f * relief_shadowing(scattering, surface, carries == CARRIES_RADIANCE ? incoming : surface->outgoing);
#endif
    return f;
}

// f for a photon from `incoming`. Its flux was weighted by the cosine to the shading normal: the lobe's may be another.
static inline float3 evaluate_for_photon(const Scattering* scattering, const Surface* surface, float3 incoming)
{
    const float3 f = bsdf_evaluate(scattering, surface, incoming, CARRIES_RADIANCE);
#if HAS_RELIEF
    if (scattering->flags & LOBE_PERTURBED) return f * fabs(dot(incoming, scattering->normal) / fmax(fabs(dot(incoming, surface->shading_normal)), 1e-3f));
#endif
    return f;
}

// For directions above the surface: of opaque lobes.
static inline float opaque_lobe_pdf_w(const Scattering* scattering, float3 outgoing, float3 incoming, float cos_i)
{
    switch (scattering->lobe) {
    case LOBE_COATED_DIFFUSE:
    case LOBE_PRINCIPLED_DIFFUSE:
    case LOBE_DIFFUSE: return diffuse_pdf_w(cos_i);
#if LOBE_OCCURS(LOBE_ROUGH_CONDUCTOR) || LOBE_OCCURS(LOBE_PRINCIPLED_SPECULAR)
    case LOBE_PRINCIPLED_SPECULAR:
    case LOBE_ROUGH_CONDUCTOR: return rough_reflection_pdf_w(scattering, outgoing, incoming);
#endif
#if LOBE_OCCURS(LOBE_CLEARCOAT)
    case LOBE_CLEARCOAT: return clearcoat_pdf_w(scattering, outgoing, incoming);
#endif
#if LOBE_OCCURS(LOBE_PHONG)
    case LOBE_PHONG: return phong_pdf_w(scattering, outgoing, incoming);
#endif
    default: return 0.0f;
    }
}

#if HAS_COATS
// Diffuse lobes are sampled as if the coat was not there: the cosine outside is nearly what they send out.
static inline float coated_pdf_w(const Scattering* scattering, float3 outgoing, float3 incoming, float cos_i)
{
    if (scattering->lobe == LOBE_DIFFUSE) return diffuse_pdf_w(cos_i);
    CoatCrossing out, in;
    if (!cross_coat(scattering, outgoing, &out) || !cross_coat(scattering, incoming, &in)) return 0.0f;
    const Scattering below = below_coat(scattering, &out);
    return opaque_lobe_pdf_w(&below, out.below, in.below, in.cosine_below) * coat_compression(scattering, &in);
}
#endif

// Density (1/sr) with which bsdf_sample chooses `incoming`. Zero for specular lobes.
static inline float bsdf_pdf_w(const Scattering* scattering, const Surface* surface, float3 incoming)
{
    const float cos_i = dot(incoming, scattering->normal);
    if (is_black_side(scattering)) return 0.0f;
#if LOBE_OCCURS(LOBE_ROUGH_DIELECTRIC)
    if (scattering->lobe == LOBE_ROUGH_DIELECTRIC) return rough_dielectric_pdf_w(scattering, surface->outgoing, incoming);
#endif
    if (cos_i <= 0.0f) return 0.0f;
#if HAS_COATS
    if (scattering->flags & LOBE_COATED) return coated_pdf_w(scattering, surface->outgoing, incoming, cos_i);
#endif
    return opaque_lobe_pdf_w(scattering, surface->outgoing, incoming, cos_i);
}

// Density (1/sr) with which bsdf_sample, of a path that comes from `incoming`, chooses the outgoing direction.
static inline float bsdf_reverse_pdf_w(const Scattering* scattering, const Surface* surface, float3 incoming)
{
    Scattering reverse = *scattering;
    reverse.cos_o = dot(incoming, scattering->normal);
    Surface seen = *surface;
    seen.outgoing = incoming;
    return bsdf_pdf_w(&reverse, &seen, surface->outgoing);
}

// What weights of joined paths ask of a lobe: its densities (1/sr) both ways.
typedef struct BsdfDensities {
    float pdf_w;         // as bsdf_pdf_w
    float reverse_pdf_w; // as bsdf_reverse_pdf_w
} BsdfDensities;

// At once, since lobes share most of the work.
static inline BsdfDensities bsdf_densities(const Scattering* scattering, const Surface* surface, float3 incoming)
{
    BsdfDensities densities = {0.0f, 0.0f};
    const float cos_i = dot(incoming, scattering->normal);
    if (!is_transmissive(scattering) && (cos_i <= 0.0f || scattering->cos_o <= 0.0f)) return densities;
#if HAS_COATS
    if (scattering->flags & LOBE_COATED) {
        densities.pdf_w = bsdf_pdf_w(scattering, surface, incoming);
        densities.reverse_pdf_w = bsdf_reverse_pdf_w(scattering, surface, incoming);
        return densities;
    }
#endif
    switch (scattering->lobe) {
    case LOBE_DIFFUSE:
        densities.pdf_w = diffuse_pdf_w(cos_i);
        densities.reverse_pdf_w = diffuse_pdf_w(scattering->cos_o);
        break;
#if LOBE_OCCURS(LOBE_ROUGH_CONDUCTOR) || LOBE_OCCURS(LOBE_PRINCIPLED_SPECULAR)
    case LOBE_PRINCIPLED_SPECULAR:
    case LOBE_ROUGH_CONDUCTOR:
        densities.pdf_w = rough_reflection_densities(scattering, surface->outgoing, incoming, &densities.reverse_pdf_w);
        break;
#endif
#if LOBE_OCCURS(LOBE_PHONG)
    case LOBE_PHONG: densities.pdf_w = densities.reverse_pdf_w = phong_pdf_w(scattering, surface->outgoing, incoming); break;
#endif
    default:
        densities.pdf_w = bsdf_pdf_w(scattering, surface, incoming);
        densities.reverse_pdf_w = bsdf_reverse_pdf_w(scattering, surface, incoming);
    }
    return densities;
}

static inline void sample_lobe(const Scattering* scattering, float3 o, float4 u, int carries, BsdfSample* sample)
{
    switch (scattering->lobe) {
#if LOBE_OCCURS(LOBE_DIELECTRIC)
    case LOBE_DIELECTRIC: *sample = sample_dielectric(scattering, o, u.z, carries); break;
#endif
#if LOBE_OCCURS(LOBE_THIN_DIELECTRIC)
    case LOBE_THIN_DIELECTRIC: *sample = sample_thin_dielectric(scattering, o, u.z); break;
#endif
#if LOBE_OCCURS(LOBE_CONDUCTOR)
    case LOBE_CONDUCTOR: *sample = sample_conductor(scattering, o); break;
#endif
#if LOBE_OCCURS(LOBE_ROUGH_CONDUCTOR)
    case LOBE_ROUGH_CONDUCTOR: *sample = sample_rough_conductor(scattering, o, u.xy); break;
#endif
#if LOBE_OCCURS(LOBE_ROUGH_DIELECTRIC)
    case LOBE_ROUGH_DIELECTRIC: *sample = sample_rough_dielectric(scattering, o, u.xyz, carries); break;
#endif
#if LOBE_OCCURS(LOBE_COATED_DIFFUSE)
    case LOBE_COATED_DIFFUSE: *sample = sample_coated_diffuse(scattering, u.xy); break;
#endif
#if LOBE_OCCURS(LOBE_PRINCIPLED_DIFFUSE)
    case LOBE_PRINCIPLED_DIFFUSE: *sample = sample_principled_diffuse(scattering, o, u.xy); break;
#endif
#if LOBE_OCCURS(LOBE_PRINCIPLED_SPECULAR)
    case LOBE_PRINCIPLED_SPECULAR: *sample = sample_principled_specular(scattering, o, u.xy); break;
#endif
#if LOBE_OCCURS(LOBE_CLEARCOAT)
    case LOBE_CLEARCOAT: *sample = sample_clearcoat(scattering, o, u.xy); break;
#endif
#if LOBE_OCCURS(LOBE_PHONG)
    case LOBE_PHONG: *sample = sample_phong(scattering, o, u.xy); break;
#endif
    case LOBE_NULL: *sample = specular_sample(-o, (float3)(1.0f)); break;
    default: *sample = sample_diffuse(scattering, u.xy); break;
    }
}

#if HAS_COATS
// False: the coat turns the light back.
static inline bool sample_coated(const Scattering* scattering, float3 o, float4 u, int carries, BsdfSample* sample)
{
    CoatCrossing out, in;
    if (!cross_coat(scattering, o, &out)) return false;
    if (scattering->lobe == LOBE_DIFFUSE) {
        *sample = sample_diffuse(scattering, u.xy);
        if (!cross_coat(scattering, sample->direction, &in)) return false;
        sample->weight /= scattering->eta * scattering->eta;
    } else {
        const Scattering below = below_coat(scattering, &out);
        sample_lobe(&below, out.below, u, carries, sample);
        if (!leave_coat(scattering, sample->direction, &in)) return false;
        sample->direction = normalize((sample->direction - scattering->normal * in.cosine_below) * scattering->eta + scattering->normal * in.cosine);
        if (sample->pdf_w != PDF_DELTA) sample->pdf_w *= coat_compression(scattering, &in);
    }
    sample->weight *= coat_passage(scattering, &out, &in);
    return true;
}
#endif

// Chooses where a path goes on. False: it is absorbed.
static inline bool bsdf_sample(const Scattering* scattering, const Surface* surface, float4 u, int carries, BsdfSample* sample)
{
    if (is_black_side(scattering)) return false;
    const float3 o = surface->outgoing;
#if HAS_COATS
    if (scattering->flags & LOBE_COATED) {
        if (!sample_coated(scattering, o, u, carries, sample)) return false;
    } else
#endif
    sample_lobe(scattering, o, u, carries, sample);
#if HAS_RELIEF
    if ((scattering->flags & BSDF_SHADOWS_RELIEF) && scattering->lobe != LOBE_NULL)
        sample->weight *= relief_shadowing(scattering, surface, carries == CARRIES_RADIANCE ? sample->direction : o);
#endif
    // A microfacet that sends light through the surface absorbs it (its weight is zero).
    return !is_black(sample->weight) && sides_agree(scattering, surface, sample->direction);
}

// Light subpaths see the adjoint BSDF: shading normals scale it [Veach 1997, section 5.3].
static inline float adjoint_shading_scale(const Surface* surface, float3 normal, float3 direction)
{
    const float numerator = fabs(dot(surface->outgoing, normal) * dot(direction, surface->geometric_normal));
    const float denominator = fabs(dot(surface->outgoing, surface->geometric_normal) * dot(direction, normal));
    return denominator > 1e-6f ? numerator / denominator : 0.0f;
}

#endif
