// Next-event estimation: light arriving straight from a source, to be confirmed by a shadow ray.
#ifndef SUNDOG_DIRECT_LIGHT_H
#define SUNDOG_DIRECT_LIGHT_H
#include "math/sampler.h"
#include "scene/continue_path.h"
#include "scene/lights.h"

// [Veach 1997, section 9.2.2], the balance heuristic for one sample of each of two techniques.
static inline float balance_heuristic(float pdf, float other_pdf) { return pdf / (pdf + other_pdf); }

// Weight of emission that BSDF sampling found, against next-event estimation that would have chosen the light with
// density light_pdf (1/sr).
static inline float emission_weight(const PathState* path, float light_pdf)
{
    return path->pdf_w == PDF_DELTA ? 1.0f : balance_heuristic(path->pdf_w, light_pdf);
}

// Whether a ray that leads straight from the lens passes what shines.
static inline bool sees_no_light(Ray ray)
{
#ifdef HIDE_EMITTERS
    return ray.horizon == RAY_FROM_LENS;
#else
    return false;
#endif
}

// Radiance of the environment where a path leaves the scene along `ray`; with `mis`, weighted as above.
static inline float3 found_environment(const SurfaceView* scene, const PathState* path, Ray ray, bool mis)
{
    if (sees_no_light(ray)) return (float3)(0.0f);
    const EnvironmentValue value = environment_value(scene, normalize(unpack(ray.direction)));
    return is_black(value.radiance) ? value.radiance : value.radiance * (mis ? emission_weight(path, value.pdf_w) : 1.0f);
}

// Radiance that a surface emits back along the ray that found it; with `mis`, weighted as above.
static inline float3 found_emission(const SurfaceView* scene, const Surface* surface, const PathState* path, Ray ray, bool mis)
{
    const uint light = light_of_hit(scene, surface);
    const float3 emitted = emitted_radiance(scene, surface, light);
    if (!mis || is_black(emitted)) return emitted;
    return emitted * emission_weight(path, light_pdf_w(scene, surface, light, ray));
}

// Radiance that one light sample sends along the outgoing direction, if its shadow ray is free. With
// `mis`, weighted against finding the same light by BSDF sampling. The shadow ray is no_ray() when
// there is nothing to ask.
static inline float3 sample_direct_light(const SurfaceView* scene, const Surface* surface, const Scattering* scattering, uint4 words, bool mis, Ray* shadow_ray)
{
    *shadow_ray = no_ray();
    LightSample light;
    if (!sample_light(scene, surface, lobe_horizon(scattering), words, &light)) return (float3)(0.0f);
    const float3 f = bsdf_evaluate(scattering, surface, light.direction, CARRIES_RADIANCE);
    if (is_black(f)) return (float3)(0.0f);
    const float weight = mis && light.pdf_w != PDF_DELTA ? balance_heuristic(light.pdf_w, bsdf_pdf_w(scattering, surface, light.direction)) : 1.0f;
    *shadow_ray = light.shadow_ray;
    return f * light.radiance * (weight * fabs(dot(light.direction, scattering->normal)));
}

#endif
