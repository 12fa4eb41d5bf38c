// Estimator: flux and number of the photons within the radius, which progressive statistics rescale
// afterwards [Hachisuka et al. 2008, section 4]. Used by sppm.
#ifndef SUNDOG_ESTIMATOR_H
#define SUNDOG_ESTIMATOR_H

typedef struct Estimate {
    float8 red, green, blue;
    int8 count;
} Estimate;

inline void estimator_begin(Estimate* estimate)
{
    estimate->red = estimate->green = estimate->blue = (float8)(0.0f);
    estimate->count = (int8)(0);
}

// Eight photons; those not in `mask` (all bits set) count nothing.
inline void estimator_add(Estimate* estimate, int8 mask, float8 t_squared, float8 red, float8 green, float8 blue)
{
    estimate->red += as_float8(mask & as_int8(red));
    estimate->green += as_float8(mask & as_int8(green));
    estimate->blue += as_float8(mask & as_int8(blue));
    estimate->count -= mask;
}

inline float sum8(float8 v)
{
    const float4 a = v.lo + v.hi;
    return (a.x + a.z) + (a.y + a.w);
}

// Flux (W, times emitted paths) and, in .w, the number of photons.
inline float4 estimator_end(const Estimate* estimate, float radius)
{
    return (float4)(sum8(estimate->red), sum8(estimate->green), sum8(estimate->blue), sum8(convert_float8(estimate->count)));
}

#endif
