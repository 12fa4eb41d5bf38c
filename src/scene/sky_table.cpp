#include "scene/sky_table.h"

#include <bit>
#include <cassert>
#include <cstdint>

namespace sundog::sky_table
{

namespace
{

constexpr std::size_t radiance_begin = turbidities * albedos * elevations * channels * sky_parameters;
constexpr std::size_t sun_begin = radiance_begin + turbidities * albedos * elevations * channels;
constexpr std::size_t end = sun_begin + turbidities * sun_segments * channels * sun_powers * limb_powers;

float number(std::size_t index)
{
    const auto bytes = sky_table_bytes();
    assert(bytes.size() == 4 * end);
    const unsigned char* b = &bytes[4 * index];
    const std::uint32_t bits = static_cast<std::uint32_t>(b[0]) | static_cast<std::uint32_t>(b[1]) << 8 |
                               static_cast<std::uint32_t>(b[2]) << 16 | static_cast<std::uint32_t>(b[3]) << 24;
    return std::bit_cast<float>(bits);
}

} // namespace

float sky_parameter(std::size_t turbidity, std::size_t albedo, std::size_t elevation, std::size_t channel, std::size_t parameter)
{
    return number((((turbidity * albedos + albedo) * elevations + elevation) * channels + channel) * sky_parameters + parameter);
}

float sky_radiance(std::size_t turbidity, std::size_t albedo, std::size_t elevation, std::size_t channel)
{
    return number(radiance_begin + ((turbidity * albedos + albedo) * elevations + elevation) * channels + channel);
}

float sun_radiance(std::size_t turbidity, std::size_t segment, std::size_t channel, std::size_t power, std::size_t limb_power)
{
    return number(sun_begin + (((turbidity * sun_segments + segment) * channels + channel) * sun_powers + power) * limb_powers +
                  limb_power);
}

} // namespace sundog::sky_table
