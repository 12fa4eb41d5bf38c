// EXR, PNG and HDR through OpenImageIO. Files are encoded in memory and written in one go, so that a
// full disk cannot leave half of one.
#include "base/errors.h"
#include "film/image_codec.h"
#include "math/srgb.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

namespace sundog {

namespace {

constexpr float largest_rgbe = 0x1.fep126f; // of RGBE: exponents are a byte

std::string one_line(std::string text)
{
    for (char& c : text)
        if (c == '\n') c = ' ';
    return text;
}

template <class T> std::vector<T> pick_rgb(const Image& image, RgbChannels rgb, T (*convert)(float), float scale)
{
    std::vector<T> out;
    out.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int channel : {rgb.r, rgb.g, rgb.b}) out.push_back(convert(scale * image.at(x, y, channel)));
    return out;
}

std::string encode_with(const char* format, const OIIO::ImageSpec& spec, const OIIO::TypeDesc& type, const void* pixels, const std::filesystem::path& file)
{
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create(format);
    if (!output) throw FileError(file.string() + ": OpenImageIO lacks this format: " + one_line(OIIO::geterror()));
    // The name only labels messages; nothing is written there.
    const bool done = output->supports("ioproxy") && output->set_ioproxy(&memory) && output->open(file.filename().string(), spec) &&
                      output->write_image(type, pixels) && output->close();
    if (!done) throw FileError(file.string() + ": cannot encode the image: " + one_line(output->geterror()));
    return {bytes.begin(), bytes.end()};
}

std::string encode_exr(const Image& image, const std::filesystem::path& file)
{
    OIIO::ImageSpec spec(image.width, image.height, image.channel_count(), OIIO::TypeDesc::FLOAT);
    spec.channelnames = image.channels;
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", ""); // else OpenImageIO adds the time, and no two files are the same
    for (const auto& [name, value] : image.metadata) spec.attribute(name, value);
    return encode_with("openexr", spec, OIIO::TypeDesc::FLOAT, image.pixels.data(), file);
}

} // namespace

bool can_encode(ImageFormat) { return true; }

std::string encode(ImageFormat format, const Image& image, RgbChannels rgb, float exposure_stops, const std::filesystem::path& file)
{
    if (format == ImageFormat::exr) return encode_exr(image, file);
    if (format == ImageFormat::png) {
        OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
        spec.attribute("oiio:ColorSpace", "sRGB");
        const auto pixels = pick_rgb<std::uint8_t>(image, rgb, srgb8_from_linear, std::exp2(exposure_stops));
        return encode_with("png", spec, OIIO::TypeDesc::UINT8, pixels.data(), file);
    }
    const OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT);
    const auto pixels = pick_rgb<float>(image, rgb, [](float value) { return std::min(value, largest_rgbe); }, 1.0f);
    return encode_with("hdr", spec, OIIO::TypeDesc::FLOAT, pixels.data(), file);
}

} // namespace sundog
