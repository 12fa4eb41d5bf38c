// From a surface to the lobe that a path meets there.
#ifndef SUNDOG_SCENE_MATERIAL_H
#define SUNDOG_SCENE_MATERIAL_H
#include "scene/dispersion.h"
#include "scene/materials/coating.h"
#include "scene/materials/perturbed_normal.h"
#include "scene/materials/phong.h"
#include "scene/materials/plastic.h"
#include "scene/materials/principled.h"
#include "scene/scattering.h"
#include "scene/texture.h"

// BSDFs inside one another: masks, blends, maps of normals, coatings. The importer refuses deeper ones.
#define MAX_BSDF_NESTING 8

// One uniform number decides again and again: each decision leaves the part of it that it did not use.
static inline bool decide(float probability, float* u)
{
    const bool happens = *u < probability;
    *u = happens ? *u / probability : (*u - probability) / (1.0f - probability);
    return happens;
}

#define HAS_RELIEF (HAS_UV && (BSDF_OCCURS(BSDF_NORMAL_MAP) || BSDF_OCCURS(BSDF_BUMP_MAP)))
#define IS_RELIEF(type) ((type) == BSDF_NORMAL_MAP || (type) == BSDF_BUMP_MAP)

// The side of a BSDF that the path is on.
static inline Bsdf facing_bsdf(const SurfaceView* scene, uint index, const Surface* surface, Scattering* scattering)
{
    Bsdf bsdf = scene->bsdfs[index];
    scattering->cos_o = dot(surface->outgoing, scattering->normal);
    if ((bsdf.flags & BSDF_TWO_SIDED) && scattering->cos_o < 0.0f) {
        bsdf = scene->bsdfs[bsdf.back];
        scattering->normal = -scattering->normal;
        scattering->cos_o = -scattering->cos_o;
    }
    return bsdf;
}

static inline bool holds_another(uint type) { return type == BSDF_MASK || type == BSDF_BLEND || IS_RELIEF(type) || IS_COAT(type); }

#define LOBES_HAVE_FACETS                                                                                                                  \
    (LOBE_OCCURS(LOBE_ROUGH_CONDUCTOR) || LOBE_OCCURS(LOBE_ROUGH_DIELECTRIC) || LOBE_OCCURS(LOBE_PRINCIPLED_SPECULAR) ||                   \
     LOBE_OCCURS(LOBE_CLEARCOAT))

// Along the texture's u, perpendicular to the normal.
static inline float3 lobe_tangent(const Surface* surface, float3 normal)
{
#if HAS_UV
    const float3 along = surface->dpdu - normal * dot(normal, surface->dpdu);
    const float length_squared = dot(along, along);
    if (length_squared > 0.0f) return along * rsqrt(length_squared);
#endif
    return make_frame(normal).s;
}

// The lobe at a surface, chosen by u in [0, 1): a mixture's parts by their weights. Whoever asks again with
// another u sees another part; in the mean all see the same BSDF.
static inline Scattering scattering_at(const SurfaceView* scene, const Surface* surface, float u)
{
    Scattering scattering;
    scattering.normal = surface->shading_normal;
    Bsdf bsdf = facing_bsdf(scene, scene->shapes[surface->shape].bsdf, surface, &scattering);
    uint relief = 0u;
    Layer layer = {false, 1.0f, (float3)(0.0f), 1.0f};
#if BSDF_OCCURS(BSDF_MASK) || BSDF_OCCURS(BSDF_BLEND) || HAS_RELIEF || HAS_COATS
    for (int level = 0; level < MAX_BSDF_NESTING && holds_another(bsdf.type); ++level) {
#if HAS_COATS
        if (IS_COAT(bsdf.type)) {
            layer = layer_of(scene, &bsdf, surface);
            const float probability = coat_probability(scene, &bsdf, surface, &layer, scattering.cos_o);
            layer.scale = 1.0f / (1.0f - probability);
            layer.passed = !decide(probability, &u);
            if (layer.passed) bsdf = facing_bsdf(scene, bsdf.nested[0], surface, &scattering);
            else take_coat(&bsdf, probability);
            continue;
        }
#endif
#if HAS_RELIEF
        if (IS_RELIEF(bsdf.type)) {
            perturb_normal(scene, &bsdf, surface, &scattering);
            relief |= LOBE_PERTURBED | (bsdf.flags & BSDF_SHADOWS_RELIEF);
            bsdf = facing_bsdf(scene, bsdf.nested[0], surface, &scattering);
            continue;
        }
#endif
        const bool chosen = decide(clamp(textured_number(scene, bsdf.weight, surface), 0.0f, 1.0f), &u);
        if (bsdf.type == BSDF_MASK && !chosen) bsdf.type = BSDF_NULL;
        else bsdf = facing_bsdf(scene, bsdf.nested[bsdf.type == BSDF_BLEND && chosen ? 1 : 0], surface, &scattering);
    }
#endif
    scattering.flags = (bsdf.flags & (BSDF_BECKMANN | BSDF_DISPERSIVE)) | relief;
    scattering.eta = bsdf.eta;
    scattering.eta_rgb = transport_reflectance(scene, unpack(bsdf.eta_rgb)); // smooth between the three: docs/spectral.md
    scattering.k_rgb = transport_reflectance(scene, unpack(bsdf.k_rgb));
    scattering.transmittance = scattering.reflectance = (float3)(1.0f);
    scattering.alpha_u = scattering.alpha_v = 0.0f;
    scattering.tangent = (float3)(0.0f);
    scattering.lobe = bsdf.type; // the first BSDF types are lobes
    switch (bsdf.type) {
    case BSDF_DIFFUSE: scattering.reflectance = transport_reflectance(scene, textured_color(scene, bsdf.reflectance, surface)); break;
    case BSDF_DIELECTRIC:
    case BSDF_THIN_DIELECTRIC:
    case BSDF_ROUGH_DIELECTRIC:
        scattering.reflectance = transport_reflectance(scene, textured_color(scene, bsdf.specular, surface));
        scattering.transmittance = transport_reflectance(scene, textured_color(scene, bsdf.transmittance, surface));
        break;
    case BSDF_CONDUCTOR:
    case BSDF_ROUGH_CONDUCTOR: scattering.reflectance = transport_reflectance(scene, textured_color(scene, bsdf.specular, surface)); break;
    default: break;
    }
#if DISPERSION
    if (bsdf.flags & BSDF_DISPERSIVE) scattering.eta_rgb = dispersed_eta(scene, &bsdf);
#endif
#if BSDF_OCCURS(BSDF_ROUGH_CONDUCTOR) || BSDF_OCCURS(BSDF_ROUGH_DIELECTRIC) || BSDF_OCCURS(BSDF_ROUGH_COATING)
    if (bsdf.type == BSDF_ROUGH_CONDUCTOR || bsdf.type == BSDF_ROUGH_DIELECTRIC) {
        scattering.alpha_u = textured_number(scene, bsdf.alpha_u, surface);
        scattering.alpha_v = textured_number(scene, bsdf.alpha_v, surface);
    }
#endif
#if BSDF_OCCURS(BSDF_PLASTIC) || BSDF_OCCURS(BSDF_ROUGH_PLASTIC)
    if (bsdf.type == BSDF_PLASTIC || bsdf.type == BSDF_ROUGH_PLASTIC) choose_plastic_lobe(scene, &bsdf, surface, u, &scattering);
#endif
#if BSDF_OCCURS(BSDF_PRINCIPLED)
    if (bsdf.type == BSDF_PRINCIPLED) choose_principled_lobe(scene, &bsdf, surface, u, &scattering);
#endif
#if BSDF_OCCURS(BSDF_PHONG)
    if (bsdf.type == BSDF_PHONG) choose_phong_lobe(scene, &bsdf, surface, u, &scattering);
#endif
#if HAS_COATS
    if (layer.passed) cover(&scattering, &layer);
#endif
    if (LOBES_HAVE_FACETS) scattering.tangent = lobe_tangent(surface, scattering.normal);
    return scattering;
}

// Whether photons have to be kept at a surface for queries: always, where a query may find any lobe but
// specular and narrow ones; or, for `narrow` lobes, only those that nothing else finds.
static inline bool wants_photons(const SurfaceView* scene, const Surface* surface, bool found_elsewhere)
{
    const uint front = scene->shapes[surface->shape].bsdf;
    const bool behind = dot(surface->outgoing, surface->shading_normal) <= 0.0f;
    uint flags = scene->bsdfs[front].flags;
    if (behind && (flags & BSDF_TWO_SIDED)) flags = scene->bsdfs[scene->bsdfs[front].back].flags;
    else if (behind && (flags & BSDF_BLACK_BACK)) return false;
    return (flags & BSDF_HAS_BROAD) || ((flags & BSDF_HAS_SMOOTH) && !found_elsewhere);
}

// Lobes with more to them than a normal, a colour and an exponent. Specular ones are never kept.
#define LOBES_ARE_LONG (LOBES_HAVE_FACETS || LOBE_OCCURS(LOBE_COATED_DIFFUSE) || LOBE_OCCURS(LOBE_PRINCIPLED_DIFFUSE) || HAS_RELIEF || HAS_COATS)

static inline void pack_lobe(const Scattering* scattering, const Surface* surface, __global LobeRecord* record)
{
    record->lobe = scattering->lobe;
    record->flags = scattering->flags;
    record->alpha_u = scattering->alpha_u;
    record->alpha_v = scattering->alpha_v;
    record->normal = pack(scattering->normal);
    record->outgoing = pack(surface->outgoing);
    record->geometric_normal = pack(surface->geometric_normal);
    record->reflectance = pack(scattering->reflectance);
    if (!LOBES_ARE_LONG) return;
    record->tangent = pack(scattering->tangent);
    record->transmittance = pack(scattering->transmittance);
    record->eta_rgb = pack(scattering->eta_rgb);
    record->k_rgb = pack(scattering->k_rgb);
    record->eta = scattering->eta;
    record->shading_normal = pack(surface->shading_normal);
}

// The lobe again, with as much of the surface as evaluating it takes.
static inline Scattering unpack_lobe(__global const LobeRecord* record, Surface* surface)
{
    Scattering scattering;
    scattering.lobe = record->lobe;
    scattering.flags = record->flags;
    scattering.alpha_u = record->alpha_u;
    scattering.alpha_v = record->alpha_v;
    scattering.normal = unpack(record->normal);
    scattering.reflectance = unpack(record->reflectance);
    surface->outgoing = unpack(record->outgoing);
    surface->geometric_normal = unpack(record->geometric_normal);
    scattering.cos_o = dot(surface->outgoing, scattering.normal);
    scattering.tangent = scattering.transmittance = scattering.eta_rgb = scattering.k_rgb = (float3)(0.0f);
    scattering.eta = 1.0f;
    surface->shading_normal = scattering.normal;
    if (!LOBES_ARE_LONG) return scattering;
    scattering.tangent = unpack(record->tangent);
    scattering.transmittance = unpack(record->transmittance);
    scattering.eta_rgb = unpack(record->eta_rgb);
    scattering.k_rgb = unpack(record->k_rgb);
    scattering.eta = record->eta;
    surface->shading_normal = unpack(record->shading_normal);
    return scattering;
}

#endif
