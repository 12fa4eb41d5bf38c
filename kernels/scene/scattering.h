// The lobe that a path meets at a surface: what is left of a BSDF once textures are read and one of its
// lobes is chosen.
#ifndef SUNDOG_SCENE_SCATTERING_H
#define SUNDOG_SCENE_SCATTERING_H
#include "math/frame.h"
#include "math/warp.h"
#include "scene/surface.h"
#include "shared/bsdf.h"
#include "shared/path.h"

// What a subpath carries: radiance is scaled by refraction, flux is not.
#define CARRIES_RADIANCE 0 // camera subpaths
#define CARRIES_FLUX 1     // light subpaths

// -D BSDF_TYPES: bit t is set where the scene has BSDFs of type t; the others are compiled out.
#ifndef BSDF_TYPES
#define BSDF_TYPES 0xffffffffu
#endif
#define BSDF_OCCURS(type) ((BSDF_TYPES >> (type)) & 1u)
// -D LOBE_TYPES: the same for the lobes that those BSDFs have.
#ifndef LOBE_TYPES
#define LOBE_TYPES 0xffffffffu
#endif
#define LOBE_OCCURS(lobe) ((LOBE_TYPES >> (lobe)) & 1u)

// Weights are divided by the probability of having chosen this lobe: in the mean over choices they add up
// to the BSDF.
typedef struct Scattering {
    uint lobe;
    uint flags; // BSDF_BECKMANN, BSDF_SHADOWS_RELIEF, LOBE_PERTURBED, LOBE_COATED
    float3 normal;  // shading normal on the side where the BSDF's front is
    float3 tangent; // along which alpha_u is measured: unit, perpendicular to the normal
    float cos_o;    // of the outgoing direction to the normal; negative behind a one-sided surface
    float3 reflectance;
    float3 transmittance;
    float3 eta_rgb;
    float3 k_rgb;
    float eta;
    float alpha_u;
    float alpha_v;
} Scattering;

typedef struct BsdfSample {
    float3 direction; // unit, away from the surface
    float3 weight;    // f |cos| / pdf_w
    float pdf_w;      // 1/sr; PDF_DELTA for a specular direction
    float eta_scale;  // squared relative index crossed (1 without refraction)
} BsdfSample;

static inline BsdfSample specular_sample(float3 direction, float3 weight)
{
    BsdfSample sample = {direction, weight, PDF_DELTA, 1.0f};
    return sample;
}

static inline float3 reflect(float3 o, float3 n, float cos_o) { return normalize(2.0f * cos_o * n - o); }

// Into a medium of relative index eta (far over near) past a normal n on the near side.
static inline float3 refract(float3 o, float3 n, float cos_o, float cos_t, float eta) { return normalize(n * (cos_o / eta - cos_t) - o / eta); }

static inline Frame lobe_frame(const Scattering* scattering)
{
    Frame frame;
    frame.s = scattering->tangent;
    frame.t = cross(scattering->normal, scattering->tangent);
    frame.n = scattering->normal;
    return frame;
}

static inline float3 to_local(Frame frame, float3 v) { return (float3)(dot(v, frame.s), dot(v, frame.t), dot(v, frame.n)); }

#endif
