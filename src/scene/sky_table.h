// The coefficients of Hosek and Wilkie's models of sky and sun for linear sRGB, as src/scene/data/hosek-wilkie-rgb.bin holds
// them: little-endian 32-bit floats, rounded from the data sets that Mitsuba 3.7.1 ships (licence: beside that file).
#pragma once

#include <span>

namespace sundog
{

std::span<const unsigned char> sky_table_bytes();

namespace sky_table
{

constexpr std::size_t turbidities = 10; // 1, 2, ... 10
constexpr std::size_t albedos = 2;      // 0 and 1
constexpr std::size_t elevations = 6;   // control points of a Bezier curve
constexpr std::size_t channels = 3;
constexpr std::size_t sky_parameters = 9;
constexpr std::size_t sun_segments = 45; // of elevation
constexpr std::size_t sun_powers = 4;    // of the elevation within its segment
constexpr std::size_t limb_powers = 6;   // of the cosine at the sun's surface

// Each array follows the one before it; the last index runs fastest.
float sky_parameter(std::size_t turbidity, std::size_t albedo, std::size_t elevation, std::size_t channel, std::size_t parameter);
float sky_radiance(std::size_t turbidity, std::size_t albedo, std::size_t elevation, std::size_t channel);
float sun_radiance(std::size_t turbidity, std::size_t segment, std::size_t channel, std::size_t power, std::size_t limb_power);

} // namespace sky_table

} // namespace sundog
