// Next-event estimation: light arriving straight from a source, to be confirmed by a shadow ray.
#ifndef SUNDOG_DIRECT_LIGHT_H
#define SUNDOG_DIRECT_LIGHT_H
#include "math/sampler.h"
#include "scene/bsdf.h"
#include "scene/lights.h"

// [Veach 1997, section 9.2.2], the balance heuristic for one sample of each of two techniques.
static inline float balance_heuristic(float pdf, float other_pdf) { return pdf / (pdf + other_pdf); }

// Radiance that one light sample sends along the outgoing direction, if its shadow ray is free. With
// `mis`, weighted against finding the same light by BSDF sampling. The shadow ray is no_ray() when
// there is nothing to ask.
static inline float3 sample_direct_light(const SurfaceView* scene, const Surface* surface, const Scattering* scattering, float4 u, bool mis, Ray* shadow_ray)
{
    *shadow_ray = no_ray();
    LightSample light;
    if (!sample_light(scene, surface, u, &light)) return (float3)(0.0f);
    const float3 f = bsdf_evaluate(scattering, surface, light.direction);
    if (is_black(f)) return (float3)(0.0f);
    const float weight = mis && light.pdf_w != PDF_DELTA ? balance_heuristic(light.pdf_w, bsdf_pdf_w(scattering, light.direction)) : 1.0f;
    *shadow_ray = light.shadow_ray;
    return f * light.radiance * (weight * fabs(dot(light.direction, scattering->normal)));
}

#endif
