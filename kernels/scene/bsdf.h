// Scattering at a surface: sample, evaluate, density; for camera and light subpaths alike.
#ifndef SUNDOG_SCENE_BSDF_H
#define SUNDOG_SCENE_BSDF_H
#include "math/frame.h"
#include "math/warp.h"
#include "scene/fresnel.h"
#include "scene/surface.h"
#include "shared/path.h"

// What a subpath carries: radiance is scaled by refraction, flux is not.
#define CARRIES_RADIANCE 0 // camera subpaths
#define CARRIES_FLUX 1     // light subpaths

typedef struct BsdfSample {
    float3 direction; // unit, away from the surface
    float3 weight;    // f |cos| / pdf_w
    float pdf_w;      // 1/sr; PDF_DELTA for a specular direction
    float eta_scale;  // squared relative index crossed (1 without refraction)
} BsdfSample;

// The BSDF on the side that `outgoing` leaves to, with the shading normal on the side where that
// BSDF's front is.
typedef struct Scattering {
    Bsdf bsdf;
    float3 normal;
    float cos_o; // of the outgoing direction to that normal; negative behind a one-sided surface
} Scattering;

static inline Scattering scattering_at(const SurfaceView* scene, const Surface* surface)
{
    Scattering scattering;
    scattering.bsdf = scene->bsdfs[scene->shapes[surface->shape].bsdf];
    scattering.normal = surface->shading_normal;
    scattering.cos_o = dot(surface->outgoing, surface->shading_normal);
    if ((scattering.bsdf.flags & BSDF_TWO_SIDED) && scattering.cos_o < 0.0f) {
        scattering.bsdf = scene->bsdfs[scattering.bsdf.back];
        scattering.normal = -scattering.normal;
        scattering.cos_o = -scattering.cos_o;
    }
    return scattering;
}

static inline bool is_specular(const Scattering* scattering) { return scattering->bsdf.type != BSDF_DIFFUSE; }

// Light that neither arrives nor leaves: the black back of an opaque one-sided surface.
static inline bool is_black_side(const Scattering* scattering)
{
    return scattering->cos_o <= 0.0f && (scattering->bsdf.type == BSDF_DIFFUSE || scattering->bsdf.type == BSDF_CONDUCTOR);
}

// f (1/sr), without the cosine, from `incoming` (unit, towards where light comes from) to the outgoing
// direction. Zero for specular BSDFs.
static inline float3 bsdf_evaluate(const Scattering* scattering, const Surface* surface, float3 incoming)
{
    const bool same_side = dot(incoming, scattering->normal) > 0.0f && scattering->cos_o > 0.0f &&
                           dot(incoming, surface->geometric_normal) * dot(surface->outgoing, surface->geometric_normal) > 0.0f;
    return scattering->bsdf.type == BSDF_DIFFUSE && same_side ? unpack(scattering->bsdf.reflectance) * INV_PI_F : (float3)(0.0f);
}

// Density (1/sr) with which bsdf_sample chooses `incoming`. Zero for specular BSDFs.
static inline float bsdf_pdf_w(const Scattering* scattering, float3 incoming)
{
    const float cos_i = dot(incoming, scattering->normal);
    return scattering->bsdf.type == BSDF_DIFFUSE && cos_i > 0.0f && scattering->cos_o > 0.0f ? cos_i * INV_PI_F : 0.0f;
}

// --- One function a model. `o` is the outgoing direction, n the side's normal. ------------------------

static inline BsdfSample specular_sample(float3 direction, float3 weight)
{
    BsdfSample sample = {direction, weight, PDF_DELTA, 1.0f};
    return sample;
}

static inline float3 reflect(float3 o, float3 n, float cos_o) { return normalize(2.0f * cos_o * n - o); }

static inline BsdfSample sample_diffuse(const Scattering* scattering, float2 u)
{
    const float3 local_direction = sample_cosine_hemisphere(u);
    BsdfSample sample;
    sample.direction = to_world(make_frame(scattering->normal), local_direction);
    sample.weight = unpack(scattering->bsdf.reflectance);
    sample.pdf_w = fmax(local_direction.z, 1e-20f) * INV_PI_F;
    sample.eta_scale = 1.0f;
    return sample;
}

static inline BsdfSample sample_dielectric(const Scattering* scattering, float3 o, float u, int carries)
{
    const bool entering = scattering->cos_o > 0.0f;
    const float3 n = entering ? scattering->normal : -scattering->normal;
    const float cos_o = fabs(scattering->cos_o);
    const float eta = entering ? scattering->bsdf.eta : 1.0f / scattering->bsdf.eta;
    float cos_t;
    const float reflected = fresnel_dielectric(cos_o, eta, &cos_t);
    // Chosen with Fresnel's probability, so it cancels out of the weight.
    if (u < reflected) return specular_sample(reflect(o, n, cos_o), unpack(scattering->bsdf.reflectance));
    const float3 refracted = normalize(n * (cos_o / eta - cos_t) - o / eta);
    BsdfSample sample = specular_sample(refracted, unpack(scattering->bsdf.transmittance));
    // Radiance is compressed by (eta_i / eta_t)^2 where light goes from the far to the near side; flux is kept.
    if (carries == CARRIES_RADIANCE) sample.weight /= eta * eta;
    sample.eta_scale = eta * eta;
    return sample;
}

// A pane: inter-reflections between its two faces summed up, R' = 2 R / (1 + R); light passes unbent.
static inline BsdfSample sample_thin_dielectric(const Scattering* scattering, float3 o, float u)
{
    const float cos_o = fabs(scattering->cos_o);
    const float3 n = scattering->cos_o > 0.0f ? scattering->normal : -scattering->normal;
    float cos_t;
    const float one_face = fresnel_dielectric(cos_o, scattering->bsdf.eta, &cos_t);
    const float reflected = one_face < 1.0f ? 2.0f * one_face / (1.0f + one_face) : 1.0f;
    if (u < reflected) return specular_sample(reflect(o, n, cos_o), unpack(scattering->bsdf.reflectance));
    return specular_sample(-o, unpack(scattering->bsdf.transmittance));
}

static inline BsdfSample sample_conductor(const Scattering* scattering, float3 o)
{
    const float3 fresnel = fresnel_conductor(scattering->cos_o, unpack(scattering->bsdf.eta_rgb), unpack(scattering->bsdf.k_rgb));
    return specular_sample(reflect(o, scattering->normal, scattering->cos_o), fresnel * unpack(scattering->bsdf.reflectance));
}

// Chooses where a path goes on. False: it is absorbed.
static inline bool bsdf_sample(const Scattering* scattering, const Surface* surface, float4 u, int carries, BsdfSample* sample)
{
    if (is_black_side(scattering)) return false;
    const float3 o = surface->outgoing;
    switch (scattering->bsdf.type) {
    case BSDF_DIFFUSE: *sample = sample_diffuse(scattering, u.xy); break;
    case BSDF_DIELECTRIC: *sample = sample_dielectric(scattering, o, u.z, carries); break;
    case BSDF_THIN_DIELECTRIC: *sample = sample_thin_dielectric(scattering, o, u.z); break;
    case BSDF_CONDUCTOR: *sample = sample_conductor(scattering, o); break;
    default: *sample = specular_sample(-o, (float3)(1.0f)); break;
    }
    // An interpolated normal can send a reflection through the face, or a refraction back: absorbed.
    const bool shading_crosses = dot(sample->direction, scattering->normal) * scattering->cos_o < 0.0f;
    const bool geometry_crosses = dot(sample->direction, surface->geometric_normal) * dot(o, surface->geometric_normal) < 0.0f;
    return shading_crosses == geometry_crosses;
}

// Light subpaths see the adjoint BSDF: interpolated normals scale it [Veach 1997, section 5.3].
static inline float adjoint_shading_scale(const Surface* surface, float3 direction)
{
    const float numerator = fabs(dot(surface->outgoing, surface->shading_normal) * dot(direction, surface->geometric_normal));
    const float denominator = fabs(dot(surface->outgoing, surface->geometric_normal) * dot(direction, surface->shading_normal));
    return denominator > 1e-6f ? numerator / denominator : 0.0f;
}

#endif
