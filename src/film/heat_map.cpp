#include "film/heat_map.h"

#include "film/error_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sundog
{

namespace
{

// From OKLab [Ottosson 2020, "A perceptual color space for image processing"] to linear sRGB.
MapColor linear_srgb(double lightness, double a, double b)
{
    const auto cubed = [](double x) { return x * x * x; };
    const double l = cubed(lightness + 0.3963377774 * a + 0.2158037573 * b);
    const double m = cubed(lightness - 0.1055613458 * a - 0.0638541728 * b);
    const double s = cubed(lightness - 0.0894841775 * a - 1.2914855480 * b);
    return {static_cast<float>(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            static_cast<float>(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            static_cast<float>(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

bool displayable(MapColor color)
{
    const auto [least, most] = std::minmax({color.r, color.g, color.b});
    return least >= 0.0f && most <= 1.0f;
}

} // namespace

MapColor map_color(double value)
{
    constexpr double darkest = 0.18, lightest = 0.95;
    constexpr double first_hue = -95.0, last_hue = 105.0; // degrees: blue, by way of purple and orange, to yellow
    const double v = std::clamp(value, 0.0, 1.0);
    const double lightness = darkest + (lightest - darkest) * v;
    const double hue = (first_hue + (last_hue - first_hue) * v) * std::numbers::pi / 180.0;
    // As colourful as a display can show.
    double chroma = 0.22;
    while (!displayable(linear_srgb(lightness, chroma * std::cos(hue), chroma * std::sin(hue)))) chroma -= 0.002;
    return linear_srgb(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
}

Image heat_map(const Image& image)
{
    Image map(image.width, image.height, {"R", "G", "B"});
    const double decades = std::log10(heat_map_most / heat_map_least);
    const std::vector<double> bounds = relative_bounds(image);
    for (std::size_t i = 0; i < bounds.size(); i++) {
        const MapColor color = map_color(std::log10(bounds[i] / heat_map_least) / decades);
        map.pixels[3 * i] = color.r;
        map.pixels[3 * i + 1] = color.g;
        map.pixels[3 * i + 2] = color.b;
    }
    return map;
}

std::string heat_map_legend()
{
    return fmt::format("relative error bound from {:g} (dark blue) by factors of 10 (purple, orange) to {:g} and more (light yellow)",
                       heat_map_least, heat_map_most);
}

} // namespace sundog
