// Surface scattering: the record of one BSDF, and the lobes that BSDFs are mixtures of.
#ifndef SUNDOG_SHARED_BSDF_H
#define SUNDOG_SHARED_BSDF_H
#include "shared/texture.h"
#include "shared/vec3.h"
SHARED_BEGIN

#define BSDF_DIFFUSE 0u          // reflectance
#define BSDF_DIELECTRIC 1u       // eta, specular and transmittance (both 1 in nature)
#define BSDF_THIN_DIELECTRIC 2u  // the same, for a pane without thickness
#define BSDF_CONDUCTOR 3u        // eta_rgb, k_rgb, specular
#define BSDF_NULL 4u             // lets all light pass
#define BSDF_ROUGH_CONDUCTOR 5u  // as a conductor, with alpha
#define BSDF_ROUGH_DIELECTRIC 6u // as a dielectric, with alpha
#define BSDF_MASK 7u             // nested[0] with probability `weight`, else null
#define BSDF_BLEND 8u            // nested[1] with probability `weight`, else nested[0]
#define BSDF_PLASTIC 9u          // a smooth dielectric coat (eta, specular) over a diffuse base (reflectance)
#define BSDF_ROUGH_PLASTIC 10u   // the same with alpha, and the coat's transmittance in eta_rgb, k_rgb, transmittance
#define BSDF_NORMAL_MAP 11u      // nested[0] about the normal that `reflectance` says
#define BSDF_BUMP_MAP 12u        // nested[0] about the normal of heights `weight`
#define BSDF_PRINCIPLED 13u      // eta, and nested[0] in `principled`
#define BSDF_PHONG 14u           // a diffuse part (reflectance) and a lobe (specular) whose exponent is alpha_u
#define BSDF_COATING 15u         // a smooth dielectric layer (eta, specular, optical depth in transmittance) over nested[0]
#define BSDF_ROUGH_COATING 16u   // the same with alpha

// Scatters on both sides: the back by the BSDF `back`. Without it, the back of
// an opaque BSDF is black, as in Mitsuba.
#define BSDF_TWO_SIDED 1u
// Some lobe that is not specular; and one that is neither specular nor narrow. Of a two-sided BSDF: of its front.
#define BSDF_HAS_SMOOTH 2u
#define BSDF_HAS_BROAD 4u
// Black from behind, whatever lobe a path chooses: opaque, and not two-sided.
#define BSDF_BLACK_BACK 16u
// The microfacets' normals are distributed by Beckmann's law; else by Trowbridge and Reitz's (GGX).
#define BSDF_BECKMANN 8u
// The base of plastic is lit again by what the coat sends back, and takes on colour each time.
#define BSDF_NONLINEAR 32u
// Of maps of normals and heights: turns normals round that face away from the path; and darkens what their relief
// would shadow.
#define BSDF_FLIPS_NORMALS 64u
#define BSDF_SHADOWS_RELIEF 128u
// A principled BSDF with a clear coat; and one that transmits.
#define BSDF_CLEARCOATED 512u
#define BSDF_TRANSMITS 1024u
// A dielectric whose index depends on the wavelength, in spectral transport: eta is that at the sodium D line, eta_rgb and
// k_rgb hold Sellmeier's first three B and C (square micrometres).
#define BSDF_DISPERSIVE (1u << 30)
#define SODIUM_D_MICROMETRES 0.5893f

// Reflections narrower than this roughness are followed by paths that look for photons, as specular
// ones are: few photons arrive from where they look. So is ground glass of any roughness, which photons
// mostly pass.
#define NARROW_ALPHA 0.15f
// Phong's lobe cos^n is as wide as the reflection by facets of alpha^2 = 1 / (2 n).
#define NARROW_EXPONENT 22.0f

typedef struct Bsdf {
    uint type;
    uint flags;
    uint back;
    float eta; // interior over exterior index of refraction; the normal points to the exterior
    TexturedColor reflectance; // of what is diffuse
    TexturedColor specular;    // factor on what is reflected at the interface
    TexturedColor transmittance;
    Vec3 eta_rgb; // complex index of refraction relative to the exterior, for red, green and blue
    float sellmeier_b4; // of a dispersive dielectric, as sellmeier_c4
    Vec3 k_rgb;
    float sellmeier_c4;
    TexturedNumber alpha_u; // roughness along the texture's u (root mean square slope, times sqrt(2))
    TexturedNumber alpha_v;
    TexturedNumber weight; // of a mask or blend; of plastic, the share of diffuse light that the coat turns back from within
    uint nested[2];
} Bsdf;
SHARED_SIZE(Bsdf, 128);

// What a path meets at a surface once it has chosen: kernels/scene/lobes has a file for each.
#define LOBE_DIFFUSE 0u
#define LOBE_DIELECTRIC 1u
#define LOBE_THIN_DIELECTRIC 2u
#define LOBE_CONDUCTOR 3u
#define LOBE_NULL 4u
#define LOBE_ROUGH_CONDUCTOR 5u
#define LOBE_ROUGH_DIELECTRIC 6u
#define LOBE_COATED_DIFFUSE 7u
#define LOBE_PRINCIPLED_DIFFUSE 8u
#define LOBE_PRINCIPLED_SPECULAR 9u
#define LOBE_CLEARCOAT 10u
#define LOBE_PHONG 11u

// Of a lobe, beside BSDF_BECKMANN and BSDF_SHADOWS_RELIEF: its normal is not the surface's shading normal.
#define LOBE_PERTURBED 256u
// It lies below a dielectric layer.
#define LOBE_COATED 2048u
// Either way its directions are not those that the lobe alone has.
#define LOBE_CHANGED (LOBE_PERTURBED | LOBE_COATED)

// How much the rough coat of plastic lets through, to the base and back out of it, from a direction of cosine c to the
// normal: a series of so many Chebyshev polynomials in 2 sqrt(c) - 1.
#define COAT_COEFFICIENTS 9

// A lobe in memory (kernels/scene/scattering.h has it in registers), for queries that evaluate it later. The second half, a
// line of a processor's cache, is neither written nor read in scenes whose lobes have no use for it (LOBES_ARE_LONG).
typedef struct LobeRecord {
    uint lobe;
    uint flags;
    float alpha_u;
    float alpha_v;
    Vec3 normal;
    Vec3 outgoing;
    Vec3 geometric_normal;
    Vec3 reflectance;

    Vec3 tangent;
    Vec3 transmittance;
    Vec3 eta_rgb;
    Vec3 k_rgb;
    float eta;
    Vec3 shading_normal; // of the surface
} LobeRecord;
SHARED_SIZE(LobeRecord, 128);

SHARED_END
#endif
