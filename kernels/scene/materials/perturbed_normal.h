// Normal and bump maps: a BSDF about another normal than the surface's shading normal.
#ifndef SUNDOG_MATERIAL_PERTURBED_NORMAL_H
#define SUNDOG_MATERIAL_PERTURBED_NORMAL_H
#include "scene/scattering.h"
#include "scene/texture.h"

#if HAS_UV
// In the frame of u, v and the normal: what a map of normals says, (x + 1) / 2 in each channel.
static inline float3 mapped_normal(const SurfaceView* scene, const Bsdf* bsdf, const Surface* surface, float3 n)
{
    const float3 relative = 2.0f * textured_color(scene, bsdf->reflectance, surface) - 1.0f;
    const float3 along = surface->dpdu - n * dot(n, surface->dpdu);
    const float length_squared = dot(along, along);
    const float3 s = length_squared > 0.0f ? along * rsqrt(length_squared) : make_frame(n).s;
    return s * relative.x + cross(n, s) * relative.y + n * relative.z;
}

// Of the surface raised along n by a map of heights, whose slope is small: how n itself turns is left out [Blinn 1978].
static inline float3 bumped_normal(const SurfaceView* scene, const Bsdf* bsdf, const Surface* surface, float3 n)
{
    const float2 slope = textured_slope(scene, bsdf->weight, surface);
    const float3 du = surface->dpdu + n * (slope.x - dot(n, surface->dpdu)), dv = surface->dpdv + n * (slope.y - dot(n, surface->dpdv));
    const float3 raised = cross(du, dv);
    return dot(raised, surface->geometric_normal) < 0.0f ? -raised : raised;
}

// Turns the normal. On the back of a two-sided BSDF the relief is seen mirrored, as the rest of the frame is.
static inline void perturb_normal(const SurfaceView* scene, const Bsdf* bsdf, const Surface* surface, Scattering* scattering)
{
    const float3 n = scattering->normal;
    const bool mirrored = dot(n, surface->shading_normal) < 0.0f;
    const float3 front = mirrored ? -n : n;
    float3 turned = bsdf->type == BSDF_NORMAL_MAP ? mapped_normal(scene, bsdf, surface, front) : bumped_normal(scene, bsdf, surface, front);
    if (mirrored) turned -= 2.0f * front * dot(front, turned);
    // One that faces away from where the path came from is turned about n by half a turn [Schuessler et al. 2017].
    if ((bsdf->flags & BSDF_FLIPS_NORMALS) && dot(surface->outgoing, turned) * dot(surface->outgoing, n) <= 0.0f) turned = 2.0f * n * dot(n, turned) - turned;
    const float length_squared = dot(turned, turned);
    if (!(length_squared > 0.0f) || !isfinite(length_squared)) return;
    scattering->normal = turned * rsqrt(length_squared);
    scattering->cos_o = dot(surface->outgoing, scattering->normal);
}
#endif

// Shadows that the relief throws on itself, for light from `direction`: without them a relief ends in a hard line where
// the shading normal's horizon is [Conty Estevez et al. 2019, Ray Tracing Gems, ch. 12].
static inline float relief_shadowing(const Scattering* scattering, const Surface* surface, float3 direction)
{
    const float cos_normal = dot(scattering->normal, surface->shading_normal), cos_light = dot(direction, surface->shading_normal);
    const float tan2_normal = 1.0f / fmax(cos_normal * cos_normal, 1e-12f) - 1.0f, tan2_light = 1.0f / fmax(cos_light * cos_light, 1e-12f) - 1.0f;
    const float alpha2 = clamp(0.125f * tan2_normal, 0.0f, 1.0f);
    return 2.0f / (1.0f + sqrt(1.0f + alpha2 * fmax(tan2_light, 0.0f)));
}

#endif
