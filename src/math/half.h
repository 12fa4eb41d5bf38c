// IEEE 754 half-precision numbers, as texels hold them.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace sundog
{

constexpr float largest_half = 65504.0f;

// Exact.
inline float float_from_half(std::uint16_t half)
{
    const int exponent = (half >> 10) & 0x1f;
    const int mantissa = half & 0x3ff;
    float value = 0.0f;
    if (exponent == 0x1f)
        value = mantissa == 0 ? INFINITY : NAN;
    else if (exponent == 0)
        value = std::ldexp(static_cast<float>(mantissa), -24);
    else
        value = std::ldexp(static_cast<float>(mantissa + 0x400), exponent - 25);
    return (half & 0x8000) != 0 ? -value : value;
}

// The nearest half, of two as near the even one. Beyond largest_half infinity; NaN stays NaN.
inline std::uint16_t half_from_float(float value)
{
    const auto sign = static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(value) >> 16 & 0x8000);
    const float size = std::abs(value);
    if (std::isnan(value)) return static_cast<std::uint16_t>(sign | 0x7e00);
    if (size >= 65520.0f) return static_cast<std::uint16_t>(sign | 0x7c00);
    // Ten bits below the leading one; numbers below 2^-14 share its last place, 2^-24.
    const int exponent = size < 0x1p-14f ? -14 : std::ilogb(size);
    const auto steps = static_cast<std::uint32_t>(std::nearbyint(std::ldexp(size, 10 - exponent))); // 1024 to 2048 where normal
    return static_cast<std::uint16_t>(sign | (static_cast<std::uint32_t>(exponent + 14) * 1024 + steps));
}

} // namespace sundog
