// Reflectance of smooth interfaces for unpolarised light.
#ifndef SUNDOG_FRESNEL_H
#define SUNDOG_FRESNEL_H
#include "math/vec3.h"

// Dielectric. eta: index on the far side over index on the near side. cos_i > 0. Writes the cosine of the
// refracted ray; returns 1 under total internal reflection.
static inline float fresnel_dielectric(float cos_i, float eta, float* cos_t)
{
    const float sin2_t = (1.0f - cos_i * cos_i) / (eta * eta);
    if (sin2_t >= 1.0f) {
        *cos_t = 0.0f;
        return 1.0f;
    }
    *cos_t = sqrt(1.0f - sin2_t);
    const float parallel = (eta * cos_i - *cos_t) / (eta * cos_i + *cos_t);
    const float perpendicular = (cos_i - eta * *cos_t) / (cos_i + eta * *cos_t);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// Conductor of index eta + i k relative to the near side [Born and Wolf, section 14.2]. cos_i > 0.
static inline float3 fresnel_conductor(float cos_i, float3 eta, float3 k)
{
    const float cos2 = cos_i * cos_i;
    const float sin2 = 1.0f - cos2;
    const float3 difference = eta * eta - k * k - sin2;
    // Where eta and k are both 0 the quotients below stay 1.
    const float3 a2_plus_b2 = fmax(sqrt(difference * difference + 4.0f * eta * eta * k * k), 1e-20f);
    const float3 a = sqrt(fmax(0.5f * (a2_plus_b2 + difference), (float3)(0.0f)));
    const float3 perpendicular_sum = a2_plus_b2 + cos2;
    const float3 perpendicular_cross = 2.0f * cos_i * a;
    const float3 perpendicular = (perpendicular_sum - perpendicular_cross) / (perpendicular_sum + perpendicular_cross);
    const float3 parallel_sum = cos2 * a2_plus_b2 + sin2 * sin2;
    const float3 parallel_cross = perpendicular_cross * sin2;
    const float3 parallel = perpendicular * (parallel_sum - parallel_cross) / (parallel_sum + parallel_cross);
    return 0.5f * (parallel + perpendicular);
}

#endif
