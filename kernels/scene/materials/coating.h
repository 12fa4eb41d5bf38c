// A dielectric layer over another BSDF: its surface reflects, smooth or by microfacets; what passes it meets what is below
// (kernels/scene/lobes/coat.h). What passes is counted as if the surface was smooth also where it is rough.
#ifndef SUNDOG_MATERIAL_COATING_H
#define SUNDOG_MATERIAL_COATING_H
#include "scene/fresnel.h"
#include "scene/scattering.h"
#include "scene/spectral.h"
#include "scene/texture.h"

#define HAS_COATS (BSDF_OCCURS(BSDF_COATING) || BSDF_OCCURS(BSDF_ROUGH_COATING))
#define IS_COAT(type) ((type) == BSDF_COATING || (type) == BSDF_ROUGH_COATING)

// The layer that a path has passed on its way to a lobe.
typedef struct Layer {
    bool passed;
    float eta;
    float3 depth; // optical, along the normal
    float scale;  // one over the probability of having passed
} Layer;

static inline Layer layer_of(const SurfaceView* scene, const Bsdf* bsdf, const Surface* surface)
{
    Layer layer = {true, bsdf->eta, transport_reflectance(scene, textured_color(scene, bsdf->transmittance, surface)), 1.0f};
    layer.depth = fmax(layer.depth, (float3)(0.0f));
    return layer;
}

// With which probability a path takes the layer's surface: by about how much light it and what is below send on.
static inline float coat_probability(const SurfaceView* scene, const Bsdf* bsdf, const Surface* surface, const Layer* layer, float cos_o)
{
    if (cos_o <= 0.0f) return 0.0f;
    float cos_t;
    const float reflected = fresnel_dielectric(fmin(cos_o, 1.0f), bsdf->eta, &cos_t);
    const float coat = reflected * dot(transport_reflectance(scene, textured_color(scene, bsdf->specular, surface)), (float3)(1.0f));
    const float base = (1.0f - reflected) * dot(exp(-2.0f * layer->depth), (float3)(1.0f));
    return coat > 0.0f ? coat / (coat + base) : 0.0f;
}

// Makes the record that of the surface alone: Fresnel's equations for dielectrics are those for conductors that do not absorb.
static inline void take_coat(Bsdf* bsdf, float probability)
{
    bsdf->eta_rgb = pack((float3)(bsdf->eta));
    bsdf->k_rgb = pack((float3)(0.0f));
    bsdf->specular.value = pack(unpack(bsdf->specular.value) / probability);
    bsdf->type = bsdf->type == BSDF_COATING ? BSDF_CONDUCTOR : BSDF_ROUGH_CONDUCTOR;
}

// A lobe below the layer.
static inline void cover(Scattering* scattering, const Layer* layer)
{
    scattering->flags |= LOBE_COATED;
    scattering->eta = layer->eta;
    scattering->transmittance = layer->depth;
    scattering->reflectance *= layer->scale;
}

#endif
