#include "math/srgb.h"

#include <cmath>

namespace sundog {

float srgb_from_linear(float linear)
{
    if (linear <= 0.0031308f) return 12.92f * linear;
    return 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float linear_from_srgb(float encoded)
{
    if (encoded <= 0.04045f) return encoded / 12.92f;
    return std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

std::uint8_t srgb8_from_linear(float linear)
{
    if (!(linear > 0.0f)) return 0; // NaN too
    if (linear >= 1.0f) return 255;
    return static_cast<std::uint8_t>(std::lround(255.0f * srgb_from_linear(linear)));
}

} // namespace sundog
