// Adds what the camera sees first to the albedo, normal and depth channels. Reads rays and hits; updates
// first_hits. One work-item a camera path. Used by every method, once an iteration.
// Albedo is linear sRGB whatever light is computed with.
#undef SPECTRAL
#undef DISPERSION
#include "math/hash.h"
#include "scene/bsdf.h"
#include "scene/camera_rays.h"
#include "shared/film.h"
#include "shared/path.h"

static inline float3 lobe_albedo(const Scattering* scattering)
{
    switch (scattering->lobe) {
    case LOBE_CONDUCTOR:
    case LOBE_ROUGH_CONDUCTOR: return scattering->reflectance * fresnel_conductor(1.0f, scattering->eta_rgb, scattering->k_rgb);
#if LOBE_OCCURS(LOBE_PRINCIPLED_SPECULAR)
    case LOBE_PRINCIPLED_SPECULAR: return principled_fresnel(scattering, 1.0f);
#endif
    case LOBE_CLEARCOAT: return scattering->reflectance * (4.0f * CLEARCOAT_F0); // f has no 1 / 4
    default: return scattering->reflectance;
    }
}

static inline float3 albedo_of(const Scattering* scattering)
{
    if (is_black_side(scattering)) return (float3)(0.0f);
#if HAS_COATS
    CoatCrossing crossing;
    if (scattering->flags & LOBE_COATED)
        return cross_coat(scattering, scattering->normal, &crossing) ? lobe_albedo(scattering) * coat_passage(scattering, &crossing, &crossing) : (float3)(0.0f);
#endif
    return lobe_albedo(scattering);
}

__kernel void record_first_hits(SURFACE_PARAMETERS, __global const Ray* restrict rays, __global const Hit* restrict hits, Camera camera, uint count,
                                uint iteration, __global FirstHitPixel* restrict first_hits)
{
    const uint path = get_global_id(0);
    if (path >= count) return;

    float3 albedo = (float3)(0.0f), normal = (float3)(0.0f);
    float depth = 0.0f;
    const Hit hit = hits[path];
    if (hit.primitive != NO_PRIMITIVE) {
        const SurfaceView scene = SURFACE_VIEW;
        const Surface surface = surface_at(&scene, rays[path], hit);
        const Scattering scattering = scattering_at(&scene, &surface, unit_float(hash_uint(hash_uint(path) + iteration)));
        albedo = albedo_of(&scattering);
        normal = facing(surface.shading_normal, surface.outgoing);
        depth = camera_distance(&camera, surface.position);
    }
    // Running means: x += (sample - x) / n.
    const float inverse_iterations = 1.0f / ((float)iteration + 1.0f);
    FirstHitPixel pixel = first_hits[path];
    pixel.albedo = pack(unpack(pixel.albedo) + (albedo - unpack(pixel.albedo)) * inverse_iterations);
    pixel.normal = pack(unpack(pixel.normal) + (normal - unpack(pixel.normal)) * inverse_iterations);
    pixel.depth += (depth - pixel.depth) * inverse_iterations;
    first_hits[path] = pixel;
}
