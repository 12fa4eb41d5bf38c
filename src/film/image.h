// An image on the host: named float channels and what made it.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <vector>

namespace sundog {

// Interleaved rows from the top; channels named as in the EXR file: "R", "G", "B" (linear sRGB
// radiance, W/m^2/sr), "variance.R", "albedo.R", "N.X", "depth.Z", ...
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels;
    std::vector<float> pixels; // width * height * channels.size()
    std::vector<std::pair<std::string, std::string>> metadata; // in order; written to EXR attributes

    Image() = default;
    Image(int w, int h, std::vector<std::string> names)
        : width(w), height(h), channels(std::move(names)), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * channels.size())
    {
    }

    int channel_count() const { return static_cast<int>(channels.size()); }
    float& at(int x, int y, int channel) { return pixels[index(x, y, channel)]; }
    float at(int x, int y, int channel) const { return pixels[index(x, y, channel)]; }

private:
    std::size_t index(int x, int y, int channel) const
    {
        assert(x >= 0 && x < width && y >= 0 && y < height && channel >= 0 && channel < channel_count());
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * channels.size() +
               static_cast<std::size_t>(channel);
    }
};

} // namespace sundog
