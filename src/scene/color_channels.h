// Which of an image's channels are its colour. They are chosen by name, never by position.
#pragma once

#include "math/vec3.h"

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sundog {

struct ColorChannels {
    enum class Model {
        rgb, // also gray, three times the same channel
        xyz, // CIE
        luminance_chroma, // Y, RY = (R - Y) / Y, BY = (B - Y) / Y
    };
    Model model = Model::rgb;
    std::array<std::size_t, 3> index{};
    std::string layer; // with its last dot; empty: the default one

    // Linear sRGB of the values of these channels.
    Vec3 color(Vec3 values) const;
};

// R, G and B of the default layer (names without a dot), else of the only layer that has them; else luminance and chroma, X Y Z
// (default layer only: those of layers are normals and places) or Y; else the only channel. Lower-case and long names (red) count
// too. Throws FileError that lists the channels.
ColorChannels color_channels(std::span<const std::string> names, const std::filesystem::path& file);

// The channel of that name, whatever its case; of "r", "g", "b", "a", also that of the colour's layer, and gray for the first
// three. Nothing, where there is none.
std::optional<std::size_t> find_channel(std::span<const std::string> names, const std::string& name);

// "R G B A".
std::string list_of_channels(std::span<const std::string> names);

} // namespace sundog
