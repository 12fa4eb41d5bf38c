// The modified Phong model: a diffuse part and a lobe, which add up to at most 1 [Lafortune and Willems 1994].
#ifndef SUNDOG_MATERIAL_PHONG_H
#define SUNDOG_MATERIAL_PHONG_H
#include "scene/spectral.h"
#include "scene/texture.h"

// Lobe or diffuse part, by their reflectances.
static inline void choose_phong_lobe(const SurfaceView* scene, const Bsdf* bsdf, const Surface* surface, float u, Scattering* scattering)
{
    const float3 specular = transport_reflectance(scene, textured_color(scene, bsdf->specular, surface));
    const float3 diffuse = transport_reflectance(scene, textured_color(scene, bsdf->reflectance, surface));
    const float specular_weight = dot(specular, (float3)(1.0f)), diffuse_weight = dot(diffuse, (float3)(1.0f));
    const float probability = specular_weight > 0.0f ? specular_weight / (specular_weight + diffuse_weight) : 0.0f;
    if (u < probability) {
        scattering->lobe = LOBE_PHONG;
        scattering->reflectance = specular / probability;
        scattering->alpha_u = fmax(textured_number(scene, bsdf->alpha_u, surface), 0.0f);
    } else {
        scattering->lobe = LOBE_DIFFUSE;
        scattering->reflectance = diffuse / (1.0f - probability);
    }
}

#endif
