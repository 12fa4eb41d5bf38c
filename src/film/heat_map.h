// A picture of where an image is good.
#pragma once

#include "film/image.h"

#include <string>

namespace sundog
{

// Linear sRGB of a value in [0, 1]: from dark blue by way of purple and orange to light yellow. Lightness (of OKLab, Ottosson 2020) grows
// in proportion, so that equal steps look equal, in grey as well.
struct MapColor {
    float r, g, b;
};
MapColor map_color(double value);

// R, G, B of the relative error bound of every pixel on a logarithmic scale, the same for all images: `heat_map_least` and
// less is the darkest, `heat_map_most` and more the lightest. The image must have error channels.
constexpr double heat_map_least = 0.001, heat_map_most = 1.0;
Image heat_map(const Image& image);

// What the colours mean, in a sentence.
std::string heat_map_legend();

} // namespace sundog
