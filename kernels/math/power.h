// Exponentials, logarithms and powers to single precision, for lobes. OpenCL's own serve any argument to the last digit, and cost
// as much as the rest of evaluating a lobe.
#ifndef SUNDOG_POWER_H
#define SUNDOG_POWER_H

// ln x of a normal number x > 0, as 2 artanh((m - 1) / (m + 1)) of its mantissa m in [1/sqrt(2), sqrt(2)). The relative error stays
// below 3e-7 where x approaches 1.
static inline float fast_log(float x)
{
    const int exponent = (as_int(x) - 0x3f3504f3) >> 23;
    const float m = as_float(as_int(x) - (exponent << 23));
    const float s = (m - 1.0f) / (m + 1.0f), t = s * s;
    const float series = 1.0f + t * (1.0f / 3.0f + t * (1.0f / 5.0f + t * (1.0f / 7.0f + t * (1.0f / 9.0f))));
    return (float)exponent * 0.693147181f + 2.0f * s * series;
}

// (e^x - 1) / x for |x| <= ln(2) / 2.
static inline float expm1_ratio(float x)
{
    return 1.0f + x * (1.0f / 2.0f + x * (1.0f / 6.0f + x * (1.0f / 24.0f + x * (1.0f / 120.0f + x * (1.0f / 720.0f + x * (1.0f / 5040.0f))))));
}

// e^x for x <= 0; 0 where that is below the normal numbers.
static inline float fast_exp(float x)
{
    if (!(x > -87.3f)) return 0.0f;
    const float octaves = rint(x * 1.44269504f);
    // ln 2 in two parts, the first of so few digits that its product is exact.
    const float rest = (x - octaves * 0.693359375f) + octaves * 2.12194440e-4f;
    return as_float(((int)octaves + 127) << 23) * (1.0f + rest * expm1_ratio(rest));
}

// 1 - e^x for x <= 0, with as many digits near 0.
static inline float one_minus_exp(float x) { return x > -0.34f ? -x * expm1_ratio(x) : 1.0f - fast_exp(x); }

// base^exponent for a base in (0, 1] and an exponent >= 0.
static inline float unit_power(float base, float exponent) { return fast_exp(exponent * fast_log(base)); }

#endif
