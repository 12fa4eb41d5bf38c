// Glass whose index depends on the wavelength. Where it bends a path, the path goes on with one of its three wavelengths,
// its hero, which has probability 1/3 and so weighs 3 [Wilkie et al. 2014, section 3]. What only reflects goes the same
// way at all wavelengths, and keeps them.
#ifndef SUNDOG_SCENE_DISPERSION_H
#define SUNDOG_SCENE_DISPERSION_H
#include "math/hash.h"
#include "scene/fresnel.h"
#include "scene/scattering.h"
#include "scene/spectral.h"
#include "shared/path.h"
#include "shared/sampler.h"

// -D DISPERSION=1 where spectral transport meets such glass.
#ifndef DISPERSION
#define DISPERSION 0
#endif

// A camera path's hero (0, 1 or 2): random in the first pass, the next one in each pass after it. By the pass and not by
// the key, for a path that is traced again with the random numbers of an earlier pass has another hero as well.
static inline uint camera_hero(const SurfaceView* scene, SamplerKey key, uint path)
{
    const uint first = hash_combine(hash_combine(hash_combine(key.seed_low, key.seed_high), STREAM_CAMERA), path);
    return (first % 3u + scene->globals->wavelengths.camera_turn) % 3u;
}

// A light path's: each path takes its turn, beginning with a random hero in the first pass and the next one in every
// third pass. Independent of camera paths: a photon counts for a query where their heroes agree, and its weight of 9 relies
// on that having probability 1/9. All nine pairs of a photon and a query that stay where they are come in nine passes.
static inline uint light_hero(const SurfaceView* scene, SamplerKey key, uint path)
{
    const uint first = hash_combine(hash_combine(STREAM_LIGHT, key.seed_low), key.seed_high);
    return (first % 3u + path % 3u + scene->globals->wavelengths.light_turn) % 3u;
}

// Square of the index at three wavelengths by Sellmeier's formula, n^2 = 1 + sum of B l^2 / (l^2 - C).
static inline float3 squared_index(const Bsdf* bsdf, float3 micrometres)
{
    const float3 l2 = micrometres * micrometres;
    return 1.0f + bsdf->eta_rgb.x * l2 / (l2 - bsdf->k_rgb.x) + bsdf->eta_rgb.y * l2 / (l2 - bsdf->k_rgb.y) + bsdf->eta_rgb.z * l2 / (l2 - bsdf->k_rgb.z) +
           bsdf->sellmeier_b4 * l2 / (l2 - bsdf->sellmeier_c4);
}

// Interior over exterior index at the pass's wavelengths; bsdf->eta is that at the sodium D line.
static inline float3 dispersed_eta(const SurfaceView* scene, const Bsdf* bsdf)
{
    return bsdf->eta * sqrt(squared_index(bsdf, unpack(scene->globals->wavelengths.micrometres)) / squared_index(bsdf, (float3)(SODIUM_D_MICROMETRES)));
}

#if DISPERSION
// The share of light that goes back, at each wavelength.
static inline float3 dispersed_reflectance(const Scattering* scattering)
{
    const float cos_o = fabs(scattering->cos_o);
    const bool inside = scattering->lobe == LOBE_DIELECTRIC && scattering->cos_o <= 0.0f;
    const float3 eta = inside ? 1.0f / scattering->eta_rgb : scattering->eta_rgb;
    float cos_t;
    const float3 one_face =
        (float3)(fresnel_dielectric(cos_o, eta.x, &cos_t), fresnel_dielectric(cos_o, eta.y, &cos_t), fresnel_dielectric(cos_o, eta.z, &cos_t));
    return scattering->lobe == LOBE_THIN_DIELECTRIC ? 2.0f * one_face / (1.0f + one_face) : one_face;
}

static inline float chosen(float3 v, uint i) { return i == 0u ? v.x : i == 1u ? v.y : v.z; }
#endif

// Fits a lobe to the path that meets it. A smooth interface reflects or transmits by the hero's reflectance F_h, and
// reflects the others by F_k / F_h; a pane, which bends nothing, transmits them by (1 - F_k) / (1 - F_h). A rough
// interface's lobe has another shape at each wavelength also where it reflects. Nothing without DISPERSION.
static inline void disperse(uint hero, const PathState* path, Scattering* scattering)
{
#if DISPERSION
    if (!(scattering->flags & BSDF_DISPERSIVE)) return;
    scattering->eta = chosen(scattering->eta_rgb, hero);
    const float3 only_hero = (float3)(hero == 0u ? 3.0f : 0.0f, hero == 1u ? 3.0f : 0.0f, hero == 2u ? 3.0f : 0.0f);
    const float3 weight = path->flags & PATH_ONE_WAVELENGTH ? (float3)(1.0f) : only_hero;
    if (scattering->lobe == LOBE_ROUGH_DIELECTRIC) {
        scattering->reflectance *= weight;
        scattering->transmittance *= weight;
        return;
    }
    const float3 reflected = dispersed_reflectance(scattering);
    const float hero_reflected = chosen(reflected, hero);
    scattering->reflectance *= reflected / fmax(hero_reflected, 1e-12f);
    if (scattering->lobe == LOBE_DIELECTRIC) scattering->transmittance *= weight;
    else scattering->transmittance *= (1.0f - reflected) / fmax(1.0f - hero_reflected, 1e-12f);
#endif
}

// What becomes of the path's other wavelengths when it follows a sample.
static inline void separate_wavelengths(const Scattering* scattering, float3 direction, PathState* path)
{
#if DISPERSION
    if (!(scattering->flags & BSDF_DISPERSIVE) || scattering->lobe == LOBE_THIN_DIELECTRIC) return;
    const bool crosses = dot(direction, scattering->normal) * scattering->cos_o < 0.0f;
    if (crosses || scattering->lobe == LOBE_ROUGH_DIELECTRIC) path->flags |= PATH_ONE_WAVELENGTH;
#endif
}

#endif
