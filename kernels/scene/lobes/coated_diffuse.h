// A diffuse base seen through a dielectric coat: f = reflectance T(cos_i) / pi, where the reflectance already holds what
// is lost towards the outgoing direction and what goes to and fro below the coat (kernels/scene/materials/plastic.h).
#ifndef SUNDOG_LOBE_COATED_DIFFUSE_H
#define SUNDOG_LOBE_COATED_DIFFUSE_H
#include "scene/fresnel.h"
#include "scene/lobes/diffuse.h"

// What a coat lets through from a direction of this cosine (> 0): a smooth one what Fresnel's equations say, a rough
// one the sum of a series whose coefficients are in eta_rgb, k_rgb and transmittance.
static inline float coat_transmission(const Scattering* scattering, float cosine)
{
    if (scattering->alpha_u == 0.0f) {
        float cos_t;
        return 1.0f - fresnel_dielectric(fmin(cosine, 1.0f), scattering->eta, &cos_t);
    }
    const float3 low = scattering->eta_rgb, middle = scattering->k_rgb, high = scattering->transmittance;
    const float coefficients[COAT_COEFFICIENTS] = {low.x, low.y, low.z, middle.x, middle.y, middle.z, high.x, high.y, high.z};
    const float x = 2.0f * sqrt(clamp(cosine, 0.0f, 1.0f)) - 1.0f;
    float b = 0.0f, b_next = 0.0f; // Clenshaw's recurrence
    for (int i = COAT_COEFFICIENTS - 1; i > 0; --i) {
        const float b_this = coefficients[i] + 2.0f * x * b - b_next;
        b_next = b;
        b = b_this;
    }
    return clamp(coefficients[0] + x * b - b_next, 0.0f, 1.0f);
}

static inline float3 evaluate_coated_diffuse(const Scattering* scattering, float cos_i)
{
    return scattering->reflectance * (coat_transmission(scattering, cos_i) * INV_PI_F);
}

static inline BsdfSample sample_coated_diffuse(const Scattering* scattering, float2 u)
{
    BsdfSample sample = sample_diffuse(scattering, u);
    sample.weight *= coat_transmission(scattering, sample.pdf_w * PI_F);
    return sample;
}

#endif
