// Light that only a specular vertex sends on, from a source that only next-event estimation finds: no path has a chance to make that
// connection, the one direction being as unlikely as the other. The specular direction is mollified to a cone, f |cos| becoming
//     W 1(angle < gamma) / (2 pi (1 - cos gamma))
// for a specular weight W, which has the same integral [Kaplanyan and Dachsbacher 2013, Path Space Regularization for Holistic and Robust
// Light Transport, section 4].
#ifndef SUNDOG_SCENE_MOLLIFIED_LIGHT_H
#define SUNDOG_SCENE_MOLLIFIED_LIGHT_H
#include "scene/bsdf.h"
#include "scene/lights.h"
#include "shared/regularization.h"

// -D REGULARIZED=1 compiles it in.
#ifndef REGULARIZED
#define REGULARIZED 0
#endif

// Whether two unit vectors make a smaller angle than the cone's; of small cones the cosine has few digits.
static inline bool within_cone(float3 a, float3 b, float one_minus_cos)
{
    const float3 between = a - b;
    return dot(between, between) < 2.0f * one_minus_cos;
}

// What one light sample brings to the path's pixel, if its shadow ray is free. words: position and choice of the light; u: of the
// specular direction. The shadow ray is no_ray() when there is nothing to ask.
static inline float3 sample_mollified_light(const SurfaceView* scene, const Surface* surface, const Scattering* scattering, float3 throughput,
                                            Regularization regularization, uint4 words, float4 u, Ray* shadow_ray)
{
    *shadow_ray = no_ray();
    LightSample light;
    if (!sample_light(scene, surface, 0u, words, &light) || light.pdf_w != PDF_DELTA) return (float3)(0.0f);
    BsdfSample sample;
    if (!bsdf_sample(scattering, surface, u, CARRIES_RADIANCE, &sample)) return (float3)(0.0f);
    if (!within_cone(sample.direction, light.direction, regularization.one_minus_cos)) return (float3)(0.0f);
    const bool crosses_surface = dot(sample.direction, surface->geometric_normal) * dot(light.direction, surface->geometric_normal) <= 0.0f;
    if (crosses_surface || !sides_agree(scattering, surface, light.direction)) return (float3)(0.0f);
    *shadow_ray = light.shadow_ray;
    return throughput * sample.weight * light.radiance * regularization.inverse_solid_angle;
}

#endif
