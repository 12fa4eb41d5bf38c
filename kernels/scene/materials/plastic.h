// Plastic: a colourless dielectric coat over a diffuse base. Light that gets through the coat is scattered by the base,
// and of that what the coat sends back (R of it, for it is diffuse) is scattered again, and so on:
// f_base = rho / (1 - rho R) T(o) T(i) / (pi eta^2); without BSDF_NONLINEAR the colour is taken on but once, rho / (1 - R).
#ifndef SUNDOG_MATERIAL_PLASTIC_H
#define SUNDOG_MATERIAL_PLASTIC_H
#include "scene/lobes/coated_diffuse.h"
#include "scene/spectral.h"
#include "scene/texture.h"

// Coat or base, by how much light each would send on.
static inline void choose_plastic_lobe(const SurfaceView* scene, const Bsdf* bsdf, const Surface* surface, float u, Scattering* scattering)
{
    const bool rough = bsdf->type == BSDF_ROUGH_PLASTIC;
    const float3 specular = transport_reflectance(scene, textured_color(scene, bsdf->specular, surface));
    const float3 diffuse = transport_reflectance(scene, textured_color(scene, bsdf->reflectance, surface));
    scattering->alpha_u = rough ? textured_number(scene, bsdf->alpha_u, surface) : 0.0f;
    scattering->alpha_v = scattering->alpha_u;
    scattering->eta_rgb = unpack(bsdf->eta_rgb);
    scattering->k_rgb = unpack(bsdf->k_rgb);
    scattering->transmittance = unpack(bsdf->transmittance.value);
    const float through = scattering->cos_o > 0.0f ? coat_transmission(scattering, scattering->cos_o) : 0.0f;
    const float coat_weight = (1.0f - through) * dot(specular, (float3)(1.0f)), base_weight = through * dot(diffuse, (float3)(1.0f));
    const float coat_probability = coat_weight > 0.0f ? coat_weight / (coat_weight + base_weight) : 0.0f;
    if (u < coat_probability) {
        // Fresnel's equations for dielectrics are those for conductors that do not absorb.
        scattering->lobe = rough ? LOBE_ROUGH_CONDUCTOR : LOBE_CONDUCTOR;
        scattering->eta_rgb = (float3)(scattering->eta);
        scattering->k_rgb = (float3)(0.0f);
        scattering->reflectance = specular / coat_probability;
        return;
    }
    scattering->lobe = LOBE_COATED_DIFFUSE;
    const float3 lost = (bsdf->flags & BSDF_NONLINEAR) ? diffuse * bsdf->weight.value : (float3)(bsdf->weight.value);
    const float scale = through / ((1.0f - coat_probability) * scattering->eta * scattering->eta);
    scattering->reflectance = diffuse / (1.0f - lost) * scale;
}

#endif
