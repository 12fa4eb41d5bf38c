// EXR, PNG and HDR through OpenImageIO. Files are encoded in memory and written in one go, so that a
// full disk cannot leave half of one.
#include "base/errors.h"
#include "film/image_codec.h"
#include "math/srgb.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cmath>

namespace sundog {

namespace {

constexpr std::string_view own_attributes = "sundog:"; // others are the format's or other programs'

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

bool holds_srgb(const OIIO::ImageSpec& spec)
{
    const std::string space = spec.get_string_attribute("oiio:ColorSpace");
    if (spec.format.is_floating_point() || OIIO::Strutil::iequals(space, "Linear")) return false;
    return OIIO::Strutil::iequals(space, "sRGB") || spec.format.basesize() == 1;
}

void linearize(Image& image, int alpha)
{
    const std::size_t channels = image.channels.size();
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (static_cast<int>(i % channels) != alpha) image.pixels[i] = linear_from_srgb(image.pixels[i]);
}

void take_metadata(Image& image, const OIIO::ImageSpec& spec)
{
    for (const auto& attribute : spec.extra_attribs) {
        const std::string name = attribute.name().string();
        if (name.starts_with(own_attributes)) image.metadata.emplace_back(name, attribute.get_string());
    }
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
    const auto pixels = pick_rgb<float>(image, rgb, [](float value) { return value; }, 1.0f);
    return encode_with("hdr", spec, OIIO::TypeDesc::FLOAT, pixels.data(), file);
}

Image decode_file(const std::filesystem::path& file)
{
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(file.string(), &config);
    if (!input) throw FileError(file.string() + ": cannot read the image: " + one_line(OIIO::geterror()));
    const OIIO::ImageSpec spec = input->spec();
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.depth > 1) throw FileError(file.string() + ": not a plain two-dimensional image");
    Image image(spec.width, spec.height, spec.channelnames);
    if (!input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, image.pixels.data()))
        throw FileError(file.string() + ": cannot read the image: " + one_line(input->geterror()));
    if (holds_srgb(spec)) linearize(image, spec.alpha_channel);
    take_metadata(image, spec);
    return image;
}

} // namespace sundog
