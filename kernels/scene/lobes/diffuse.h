// Lambert's lobe: f = reflectance / pi.
#ifndef SUNDOG_LOBE_DIFFUSE_H
#define SUNDOG_LOBE_DIFFUSE_H
#include "scene/scattering.h"

static inline float3 evaluate_diffuse(const Scattering* scattering) { return scattering->reflectance * INV_PI_F; }

static inline float diffuse_pdf_w(float cos_i) { return fmax(cos_i, 0.0f) * INV_PI_F; }

static inline BsdfSample sample_diffuse(const Scattering* scattering, float2 u)
{
    const float3 local_direction = sample_cosine_hemisphere(u);
    BsdfSample sample;
    sample.direction = to_world(make_frame(scattering->normal), local_direction);
    sample.weight = scattering->reflectance;
    sample.pdf_w = fmax(local_direction.z, 1e-20f) * INV_PI_F;
    sample.eta_scale = 1.0f;
    return sample;
}

#endif
