// Phong's lobe about the mirrored direction, so scaled that it never reflects more than arrives:
// f = reflectance (n + 2) / (2 pi) cos^n [Lafortune and Willems 1994]. Of the lobe: alpha_u is the exponent n.
#ifndef SUNDOG_LOBE_PHONG_H
#define SUNDOG_LOBE_PHONG_H
#include "math/power.h"
#include "math/warp.h"
#include "scene/scattering.h"

// cos^n on the hemisphere about the mirrored direction: 0 beyond it also where n is 0.
static inline float phong_power(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    const float cosine = dot(2.0f * scattering->cos_o * scattering->normal - outgoing, incoming);
    return cosine > 0.0f ? unit_power(fmin(cosine, 1.0f), scattering->alpha_u) : 0.0f;
}

static inline float3 evaluate_phong(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    return scattering->reflectance * ((scattering->alpha_u + 2.0f) * (0.5f * INV_PI_F) * phong_power(scattering, outgoing, incoming));
}

static inline float phong_pdf_w(const Scattering* scattering, float3 outgoing, float3 incoming)
{
    return (scattering->alpha_u + 1.0f) * (0.5f * INV_PI_F) * phong_power(scattering, outgoing, incoming);
}

// cos = u^(1 / (n + 1)); the sine from 1 - cos^2 = 1 - exp(2 ln(u) / (n + 1)), which has digits where n is large.
static inline BsdfSample sample_phong(const Scattering* scattering, float3 outgoing, float2 u)
{
    const float n = scattering->alpha_u;
    const float log_cosine = fast_log(1.0f - u.x) / (n + 1.0f);
    const float cosine = fast_exp(log_cosine), sine = sqrt(one_minus_exp(2.0f * log_cosine)), phi = PI_F * (2.0f * u.y - 1.0f);
    const Frame frame = make_frame(normalize(2.0f * scattering->cos_o * scattering->normal - outgoing));
    BsdfSample sample;
    sample.direction = to_world(frame, (float3)(sine * native_cos(phi), sine * native_sin(phi), cosine));
    sample.pdf_w = fmax((n + 1.0f) * (0.5f * INV_PI_F) * fast_exp(n * log_cosine), 1e-20f);
    sample.weight = scattering->reflectance * ((n + 2.0f) / (n + 1.0f) * fmax(dot(sample.direction, scattering->normal), 0.0f));
    sample.eta_scale = 1.0f;
    return sample;
}

#endif
