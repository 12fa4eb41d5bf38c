// Images to bytes and back, one function a format; image_io.h chooses among them.
#pragma once

#include "film/image.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace sundog {

enum class ImageFormat { exr, png, hdr, pfm };

// Of the "R", "G", "B" channels, or thrice the only channel of a grey image.
struct RgbChannels {
    int r, g, b;
};

// Throws FileError, naming the file and the channels that there are.
RgbChannels rgb_channels(const Image& image, const std::filesystem::path& file);

std::string encode_pfm(const Image& image, RgbChannels rgb);
Image decode_pfm(std::string_view bytes, const std::filesystem::path& file);

// What the build's image library adds (image_codec_oiio.cpp, image_codec_minimal.cpp).
bool can_encode(ImageFormat format);
std::string encode(ImageFormat format, const Image& image, RgbChannels rgb, float exposure_stops, const std::filesystem::path& file);

} // namespace sundog
