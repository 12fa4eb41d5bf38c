// From one vertex of a path to the next: BSDF sampling and Russian roulette.
#ifndef SUNDOG_CONTINUE_PATH_H
#define SUNDOG_CONTINUE_PATH_H
#include "math/sampler.h"
#include "scene/bsdf.h"
#include "scene/light_choice.h"
#include "shared/path.h"

static inline void scatter_path(PathState* path, const BsdfSample* sample, float3 throughput)
{
    path->throughput = pack(throughput);
    path->pdf_w = sample->pdf_w;
    path->depth += 1u;
    path->scattered += sample->pdf_w != PDF_DELTA ? 1u : 0u;
    path->eta_scale *= sample->eta_scale;
}

// For which side of a vertex lights are chosen, with the normal that its lobe has: what light arrives from behind is
// lost to all but transmissive ones.
static inline uint lobe_horizon(const Scattering* scattering) { return LIGHT_TREE ? pack_horizon(scattering->normal, is_transmissive(scattering)) : 0u; }

// With which a camera path of this throughput goes on in Russian roulette: by throughput without the radiance scale of
// refraction, which is undone when the path leaves the glass again.
static inline float camera_survival(float3 throughput, float eta_scale) { return fmin(max3(fabs(throughput)) * eta_scale, 0.95f); }

// Extends a camera path by given random numbers; writes its next ray. False: the path ends here.
static inline bool extend_camera_path(const Surface* surface, const Scattering* scattering, PathRules rules, float4 u, PathState* path, Ray* ray)
{
    BsdfSample sample;
    if (!bsdf_sample(scattering, surface, u, CARRIES_RADIANCE, &sample)) return false;
    float3 throughput = unpack(path->throughput) * sample.weight;
    if (path->depth >= rules.rr_depth) {
        const float survival = camera_survival(throughput, path->eta_scale * sample.eta_scale);
        if (!(u.w < survival)) return false;
        throughput /= survival;
    }
    if (is_black(throughput)) return false;
    scatter_path(path, &sample, throughput);
    separate_wavelengths(scattering, sample.direction, path);
    *ray = ray_from(surface, sample.direction);
    ray->horizon = lobe_horizon(scattering);
#ifdef HIDE_EMITTERS
    if (sample.pdf_w != PDF_DELTA || any(sample.direction != -surface->outgoing)) path->flags |= PATH_TURNED;
    if (!(path->flags & PATH_TURNED)) ray->horizon = RAY_FROM_LENS;
#endif
    return true;
}

static inline bool continue_camera_path(const Surface* surface, const Scattering* scattering, PathRules rules, Sampler* sampler, PathState* path, Ray* ray)
{
    return extend_camera_path(surface, scattering, rules, next_4d(sampler), path, ray);
}

// Extends a light path. Survival by albedo, so that photons keep equal flux.
static inline bool continue_light_path(const Surface* surface, const Scattering* scattering, PathRules rules, Sampler* sampler, PathState* path, Ray* ray)
{
    const float4 u = next_4d(sampler);
    BsdfSample sample;
    if (!bsdf_sample(scattering, surface, u, CARRIES_FLUX, &sample)) return false;
    float3 weight = sample.weight * adjoint_shading_scale(surface, scattering->normal, sample.direction);
    if (path->depth >= rules.rr_depth) {
        const float3 flux = unpack(path->throughput);
        const float survival = fmin(max3(flux * weight) / max3(flux), 1.0f);
        if (!(u.w < survival)) return false;
        weight /= survival;
    }
    const float3 flux = unpack(path->throughput) * weight;
    if (is_black(flux)) return false;
    scatter_path(path, &sample, flux);
    separate_wavelengths(scattering, sample.direction, path);
    *ray = ray_from(surface, sample.direction);
    return true;
}

// Light arriving per geometric area becomes irradiance about the shading normal: |cos_s| / |cos_g| at
// the vertex where a light path ends, see [Veach 1997, section 5.3].
static inline float irradiance_scale(const Surface* surface, float3 normal)
{
    const float cos_g = fabs(dot(surface->outgoing, surface->geometric_normal));
    return cos_g > 1e-4f ? fabs(dot(surface->outgoing, normal)) / cos_g : 0.0f;
}

#endif
