// Distributions of microfacet normals, anisotropic: Beckmann's and Trowbridge and Reitz's (GGX), with Smith's
// separable masking and sampling of visible normals. All vectors in the lobe's frame, z the normal.
// [Walter et al. 2007; Heitz 2014, JCGT 3(2)]
#ifndef SUNDOG_MICROFACET_H
#define SUNDOG_MICROFACET_H
#include "math/warp.h"
#include "scene/scattering.h"

#define SQRT_PI_F 1.77245385090552f

typedef struct Microfacets {
    float alpha_u, alpha_v;
    bool beckmann;
} Microfacets;

// Below this roughness the density of normals overflows a float's squares.
#define MIN_ALPHA 1e-3f

static inline Microfacets lobe_microfacets(const Scattering* scattering)
{
    const Microfacets m = {fmax(scattering->alpha_u, MIN_ALPHA), fmax(scattering->alpha_v, MIN_ALPHA), (scattering->flags & BSDF_BECKMANN) != 0u};
    return m;
}

// D(h), 1/sr: density of normals per projected area, so that D(h) cos h integrates to 1. Zero below the surface.
static inline float microfacet_d(const Microfacets* m, float3 h)
{
    if (h.z <= 0.0f) return 0.0f;
    const float cos2 = h.z * h.z;
    const float slope2 = (squared(h.x / m->alpha_u) + squared(h.y / m->alpha_v)) / cos2;
    const float base = PI_F * m->alpha_u * m->alpha_v * cos2 * cos2;
    return m->beckmann ? exp(-slope2) / base : 1.0f / (base * squared(1.0f + slope2));
}

// Smith's Lambda, masked over visible area [Heitz 2014, eq. 68 and 72].
static inline float microfacet_lambda(const Microfacets* m, float3 v)
{
    const float alpha_tan2 = (squared(v.x * m->alpha_u) + squared(v.y * m->alpha_v)) / (v.z * v.z);
    if (!m->beckmann) return 0.5f * (sqrt(1.0f + alpha_tan2) - 1.0f);
    if (alpha_tan2 < 0.05f) return 0.0f; // below 1e-9
    const float a = rsqrt(alpha_tan2);
    return 0.5f * (exp(-a * a) / (a * SQRT_PI_F) - erfc(a));
}

static inline float microfacet_g1(const Microfacets* m, float3 v) { return 1.0f / (1.0f + microfacet_lambda(m, v)); }

// Seen from o (o.z > 0): density (1/sr) of visible normals [Heitz 2014, eq. 2 of the sampling supplement].
static inline float visible_normal_pdf(const Microfacets* m, float3 o, float3 h)
{
    return microfacet_d(m, h) * microfacet_g1(m, o) * fmax(dot(o, h), 0.0f) / o.z;
}

// Projection of a hemisphere stretched to roughness 1 [Heitz 2018, JCGT 7(4)].
static inline float3 sample_visible_ggx(float3 o, float2 u)
{
    const float across = o.x * o.x + o.y * o.y;
    const float3 t1 = across > 0.0f ? (float3)(-o.y, o.x, 0.0f) * rsqrt(across) : (float3)(1.0f, 0.0f, 0.0f);
    const float3 t2 = cross(o, t1);
    const float r = sqrt(u.x), phi = PI_F * (2.0f * u.y - 1.0f);
    const float p1 = r * native_cos(phi);
    const float s = 0.5f * (1.0f + o.z);
    const float p2 = (1.0f - s) * sqrt(fmax(0.0f, 1.0f - p1 * p1)) + s * r * native_sin(phi);
    return t1 * p1 + t2 * p2 + o * sqrt(fmax(0.0f, 1.0f - p1 * p1 - p2 * p2));
}

// Inverse of erf on (-1, 1) [Giles 2011, Approximating the erfinv function].
static inline float erf_inverse(float x)
{
    float w = -log((1.0f - x) * (1.0f + x));
    float p;
    if (w < 5.0f) {
        w -= 2.5f;
        p = 2.81022636e-08f;
        p = 3.43273939e-07f + p * w;
        p = -3.5233877e-06f + p * w;
        p = -4.39150654e-06f + p * w;
        p = 0.00021858087f + p * w;
        p = -0.00125372503f + p * w;
        p = -0.00417768164f + p * w;
        p = 0.246640727f + p * w;
        p = 1.50140941f + p * w;
    } else {
        w = sqrt(w) - 3.0f;
        p = -0.000200214257f;
        p = 0.000100950558f + p * w;
        p = 0.00134934322f + p * w;
        p = -0.00367342844f + p * w;
        p = 0.00573950773f + p * w;
        p = -0.0076224613f + p * w;
        p = 0.00943887047f + p * w;
        p = 1.00167406f + p * w;
        p = 2.83297682f + p * w;
    }
    return p * x;
}

// Visible slopes of Beckmann's distribution at roughness 1, o in the plane y = 0. The slope along o has the
// distribution function (1 + erf(s) + tan / sqrt(pi) exp(-s^2)) / C on s < cot [Heitz and d'Eon 2014], inverted by
// bisection and Newton's method in erf(s); the slope across is normal.
static inline float2 sample_beckmann_slopes(float tan_o, float2 u)
{
    const float across = erf_inverse(clamp(2.0f * u.y - 1.0f, -0.999999f, 0.999999f));
    if (tan_o < 1e-4f) { // from straight above: radial
        const float r = sqrt(-log(fmax(1.0f - u.x, 1e-7f)));
        const float phi = 2.0f * PI_F * u.y;
        return (float2)(r * cos(phi), r * sin(phi));
    }
    const float cot = 1.0f / tan_o;
    const float weight = tan_o / SQRT_PI_F;
    float low = -0.9999999f, high = fmin(erf(cot), 0.9999999f);
    const float target = fmax(u.x, 1e-6f) * (1.0f + erf(cot) + weight * exp(-cot * cot));
    float x = 0.5f * (low + high);
    for (int i = 0; i < 12; ++i) {
        const float slope = erf_inverse(x);
        const float error = 1.0f + x + weight * exp(-slope * slope) - target;
        if (fabs(error) < 1e-6f) break;
        if (error > 0.0f) high = x;
        else low = x;
        const float next = x - error / (1.0f - slope * tan_o); // d exp(-s^2) / d erf(s) = -sqrt(pi) s
        x = next > low && next < high ? next : 0.5f * (low + high);
    }
    return (float2)(erf_inverse(x), across);
}

static inline float3 sample_visible_beckmann(float3 o, float2 u)
{
    const float sine = sqrt(o.x * o.x + o.y * o.y);
    const float2 along = sine > 1e-6f ? o.xy / sine : (float2)(1.0f, 0.0f);
    const float2 slopes = sample_beckmann_slopes(sine / o.z, u);
    return (float3)(-(along.x * slopes.x - along.y * slopes.y), -(along.y * slopes.x + along.x * slopes.y), 1.0f);
}

// A normal seen from o, with visible_normal_pdf.
static inline float3 sample_visible_normal(const Microfacets* m, float3 o, float2 u)
{
    // Stretched, the distribution is isotropic with roughness 1; normals are scaled back.
    const float3 stretched = normalize((float3)(m->alpha_u * o.x, m->alpha_v * o.y, o.z));
    const float3 h = m->beckmann ? sample_visible_beckmann(stretched, u) : sample_visible_ggx(stretched, u);
    return normalize((float3)(m->alpha_u * h.x, m->alpha_v * h.y, fmax(h.z, 1e-6f)));
}

#endif
