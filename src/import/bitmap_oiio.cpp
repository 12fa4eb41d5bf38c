#include "import/bitmap.h"

#include "base/regular_file.h"
#include "math/half.h"
#include "math/srgb.h"
#include "scene/texel_values.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace sundog
{

namespace
{

constexpr long long max_texels = 1LL << 28;
constexpr int max_channels = 64;

[[noreturn]] void unreadable(const std::filesystem::path& file, const SourceLocation& wanted_at, std::string reason)
{
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw SceneError(wanted_at, "'" + file.string() + "': cannot read the image: " + reason);
}

// Channels of red, green and blue.
std::array<std::size_t, 3> rgb_of(int channels)
{
    if (channels >= 3) return {0, 1, 2};
    return {0, 0, 0};
}

template <class T> std::vector<T> read_pixels(OIIO::ImageInput& input, OIIO::TypeDesc type, const std::filesystem::path& file, const SourceLocation& wanted_at)
{
    const OIIO::ImageSpec& spec = input.spec();
    std::vector<T> pixels(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) * static_cast<std::size_t>(spec.nchannels));
    if (!input.read_image(0, 0, 0, spec.nchannels, type, pixels.data())) unreadable(file, wanted_at, input.geterror());
    return pixels;
}

std::vector<uint> pack_bytes(const std::vector<unsigned char>& pixels, int channels)
{
    const auto rgb = rgb_of(channels);
    std::vector<uint> texels;
    texels.reserve(pixels.size() / static_cast<std::size_t>(channels));
    for (std::size_t i = 0; i < pixels.size(); i += static_cast<std::size_t>(channels))
        texels.push_back(static_cast<uint>(pixels[i + rgb[0]]) | static_cast<uint>(pixels[i + rgb[1]]) << 8 | static_cast<uint>(pixels[i + rgb[2]]) << 16);
    return texels;
}

// Red, green and blue of all pixels, linear and finite.
std::vector<float> linear_values(const std::vector<float>& pixels, int channels, bool encoded, bool& replaced)
{
    const auto rgb = rgb_of(channels);
    std::vector<float> values;
    values.reserve(3 * pixels.size() / static_cast<std::size_t>(channels));
    for (std::size_t i = 0; i < pixels.size(); i += static_cast<std::size_t>(channels)) {
        for (const std::size_t channel : rgb) {
            float value = encoded ? linear_from_srgb(pixels[i + channel]) : pixels[i + channel];
            if (!std::isfinite(value)) {
                replaced = true;
                value = std::isnan(value) ? 0.0f : std::copysign(largest_half, value);
            }
            values.push_back(value);
        }
    }
    return values;
}

OIIO::TypeDesc file_type(TexelFormat format)
{
    switch (format) {
    case TexelFormat::srgb8:
    case TexelFormat::linear8:
        return OIIO::TypeDesc::UINT8;
    case TexelFormat::half:
        return OIIO::TypeDesc::HALF;
    case TexelFormat::float32:
        return OIIO::TypeDesc::FLOAT;
    }
    throw std::logic_error("a texel format that cannot be written");
}

std::unique_ptr<OIIO::ImageInput> open_plane(const std::filesystem::path& file, const SourceLocation& wanted_at)
{
    if (const std::string fault = not_a_regular_file(file); !fault.empty()) unreadable(file, wanted_at, fault);
    auto input = OIIO::ImageInput::open(file.string());
    if (!input) unreadable(file, wanted_at, OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1) unreadable(file, wanted_at, "it has no pixels in a plane");
    // A few kilobytes of PNG can claim, and hold, gigabytes of pixels.
    if (static_cast<long long>(spec.width) * spec.height > max_texels || spec.nchannels > max_channels)
        unreadable(file, wanted_at, "it has more than 2^28 pixels or 64 channels");
    return input;
}

// Red, green and blue of all texels.
template <class T> std::vector<T> unpack(const TexelImage& image)
{
    constexpr std::size_t bits = 8 * sizeof(T);
    const std::size_t words = image.words_per_texel();
    std::vector<T> pixels;
    pixels.reserve(3 * image.texels.size() / words);
    for (std::size_t i = 0; i < image.texels.size(); i += words)
        for (std::size_t c = 0; c < 3; c++) pixels.push_back(static_cast<T>(image.texels[i + c * bits / 32] >> (c * bits % 32)));
    return pixels;
}

} // namespace

TexelImage load_bitmap(const std::filesystem::path& file, const SourceLocation& wanted_at, bool raw, bool& replaced)
{
    const auto input = open_plane(file, wanted_at);
    const OIIO::ImageSpec& spec = input->spec();
    TexelImage image;
    image.width = spec.width;
    image.height = spec.height;
    if (spec.format == OIIO::TypeDesc::UINT8) {
        image.format = raw ? TexelFormat::linear8 : TexelFormat::srgb8;
        image.texels = pack_bytes(read_pixels<unsigned char>(*input, OIIO::TypeDesc::UINT8, file, wanted_at), spec.nchannels);
        return image;
    }
    const bool encoded = !raw && !spec.format.is_floating_point();
    set_linear_texels(image,
                      linear_values(read_pixels<float>(*input, OIIO::TypeDesc::FLOAT, file, wanted_at), spec.nchannels, encoded, replaced));
    return image;
}

TexelImage load_environment(const std::filesystem::path& file, const SourceLocation& wanted_at, bool& cleaned)
{
    const auto input = open_plane(file, wanted_at);
    const OIIO::ImageSpec& spec = input->spec();
    TexelImage image;
    image.width = spec.width;
    image.height = spec.height;
    image.format = TexelFormat::float32;
    const bool encoded = !spec.format.is_floating_point();
    const auto pixels = read_pixels<float>(*input, OIIO::TypeDesc::FLOAT, file, wanted_at);
    const auto rgb = rgb_of(spec.nchannels);
    image.texels.reserve(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    for (std::size_t i = 0; i < pixels.size(); i += static_cast<std::size_t>(spec.nchannels)) {
        for (const std::size_t channel : rgb) {
            float value = encoded ? linear_from_srgb(pixels[i + channel]) : pixels[i + channel];
            if (!(value >= 0.0f) || !std::isfinite(value)) {
                cleaned = true;
                value = 0.0f;
            }
            image.texels.push_back(std::bit_cast<uint>(value));
        }
    }
    return image;
}

std::string encode_bitmap(const TexelImage& image, const std::filesystem::path& file)
{
    const OIIO::TypeDesc type = file_type(image.format);
    OIIO::ImageSpec spec(image.width, image.height, 3, type);
    spec.attribute("DateTime", ""); // else OpenImageIO adds the time, and no two files are the same
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create(type == OIIO::TypeDesc::UINT8 ? "png" : "openexr");
    const bool opened = output && output->set_ioproxy(&memory) && output->open(file.filename().string(), spec);
    const auto write = [&](const auto& pixels) { return output->write_image(type, pixels.data()) && output->close(); };
    bool done = opened;
    if (opened && image.format == TexelFormat::float32)
        done = write(unpack<uint>(image));
    else if (opened && image.format == TexelFormat::half)
        done = write(unpack<std::uint16_t>(image));
    else if (opened)
        done = write(unpack<std::uint8_t>(image));
    if (!done) throw FileError(file.string() + ": cannot encode the image: " + (output ? output->geterror() : OIIO::geterror()));
    return {bytes.begin(), bytes.end()};
}

} // namespace sundog
