// Linear light to what a screen shows, and back (IEC 61966-2-1, sRGB).
#pragma once

#include <cstdint>

namespace sundog {

// The sRGB transfer curve.
float srgb_from_linear(float linear);
float linear_from_srgb(float encoded);

// 0..255; values outside [0, 1] are clamped, NaN is 0.
std::uint8_t srgb8_from_linear(float linear);

} // namespace sundog
