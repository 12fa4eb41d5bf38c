// Schlick's approximation of Fresnel's reflectance: F0 + (F90 - F0) w [Schlick 1994].
#ifndef SUNDOG_SCHLICK_H
#define SUNDOG_SCHLICK_H

static inline float fifth_power_of_rest(float cosine)
{
    const float rest = clamp(1.0f - cosine, 0.0f, 1.0f);
    return rest * rest * rest * rest * rest;
}

// w at an interface of relative index eta. Into the thinner medium it follows the refracted ray's angle, and is 1 where
// reflection is total [Burley 2015, section 4.2].
static inline float schlick_weight(float cosine, float eta)
{
    if (eta >= 1.0f) return fifth_power_of_rest(cosine);
    return fifth_power_of_rest(sqrt(fmax(1.0f - (1.0f - cosine * cosine) / (eta * eta), 0.0f)));
}

#endif
