#include "film/image_io.h"

#include "base/atomic_file.h"
#include "base/errors.h"
#include "base/log.h"
#include "base/readable_file.h"
#include "base/regular_file.h"
#include "film/image_codec.h"
#include "math/srgb.h"
#include "scene/color_channels.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <optional>

namespace sundog {

namespace {

namespace fs = std::filesystem;

struct Ending {
    ImageFormat format;
    const char* text;
};
constexpr std::array<Ending, 4> endings{{{ImageFormat::exr, ".exr"}, {ImageFormat::png, ".png"}, {ImageFormat::hdr, ".hdr"}, {ImageFormat::pfm, ".pfm"}}};

std::string lower(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string lower_ending(const fs::path& path)
{
    return lower(path.extension().string());
}

bool available(ImageFormat format) { return format == ImageFormat::pfm || can_encode(format); }

ImageFormat format_to_write(const fs::path& path)
{
    const std::string ending = lower_ending(path);
    for (const Ending& known : endings)
        if (ending == known.text && available(known.format)) return known.format;
    const std::string what = ending.empty() ? "has no ending" : "has the unknown ending " + ending;
    throw FileError(path.string() + ": the image's name " + what + "; use " + writable_endings());
}

// NaN is 0, infinity the largest number. Says how many there were.
Image finite_image(Image image, const fs::path& path)
{
    std::map<std::string, std::size_t> counts;
    for (std::size_t i = 0; i < image.pixels.size(); i++) {
        float& value = image.pixels[i];
        if (std::isfinite(value)) continue;
        counts[image.channels[i % image.channels.size()]]++;
        value = std::isnan(value) ? 0.0f : std::copysign(std::numeric_limits<float>::max(), value);
    }
    std::string list;
    for (const auto& [channel, count] : counts) list += (list.empty() ? "" : ", ") + std::to_string(count) + " of " + channel;
    log_warning(path.string() + ": values are not finite and are written as the largest number, or 0 for NaN: " + list);
    return image;
}

// Without compression: the whole image is no longer than its file.
class PfmFile : public ImageFile {
public:
    explicit PfmFile(const fs::path& path)
    {
        std::ifstream file(path, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
        if (!file.is_open() || file.bad()) throw FileError(path.string() + ": cannot read; check its permissions");
        image_ = decode_pfm(bytes, path);
        header_.width = image_.width;
        header_.height = image_.height;
        header_.type = SampleType::real;
        header_.channels = image_.channels;
    }

    std::span<const float> next_row() override
    {
        const std::size_t row = static_cast<std::size_t>(image_.width) * image_.channels.size();
        return std::span(image_.pixels).subspan(static_cast<std::size_t>(y_++) * row, row);
    }

private:
    Image image_;
    int y_ = 0;
};

constexpr std::string_view own_attributes = "sundog:"; // others are the format's or other programs'

// Without pixels.
Image header_of(const ImageFile& file)
{
    Image image;
    image.width = file.header().width;
    image.height = file.header().height;
    image.channels = file.header().channels;
    for (const auto& attribute : file.header().attributes)
        if (attribute.first.starts_with(own_attributes)) image.metadata.push_back(attribute);
    return image;
}

} // namespace

std::string writable_endings()
{
    std::vector<std::string> names;
    for (const Ending& known : endings)
        if (available(known.format)) names.emplace_back(known.text);
    std::string text = names.front();
    for (std::size_t i = 1; i < names.size(); ++i) text += (i + 1 < names.size() ? ", " : " or ") + names[i];
    return text;
}

RgbChannels rgb_channels(const Image& image, const fs::path& file)
{
    const ColorChannels color = color_channels(image.channels, file);
    if (color.model != ColorChannels::Model::rgb) throw FileError(file.string() + ": its channels are not R, G and B but " + list_of_channels(image.channels));
    const auto place = [&](std::size_t i) { return static_cast<int>(color.index[i]); };
    return {place(0), place(1), place(2)};
}

void write_image(const fs::path& path, const Image& original, float exposure_stops)
{
    const ImageFormat format = format_to_write(path);
    const auto is_finite = [](float value) { return std::isfinite(value); };
    const bool finite = std::all_of(original.pixels.begin(), original.pixels.end(), is_finite);
    const Image made_finite = finite ? Image() : finite_image(original, path);
    const Image& image = finite ? original : made_finite;
    const RgbChannels rgb = format == ImageFormat::exr ? RgbChannels{} : rgb_channels(image, path);
    write_file(path, format == ImageFormat::pfm ? encode_pfm(image, rgb) : encode(format, image, rgb, exposure_stops, path));
}

std::unique_ptr<ImageFile> open_image_file(const fs::path& path)
{
    std::error_code error;
    if (!fs::exists(path, error)) throw FileError(path.string() + ": cannot read, there is no such file");
    if (fs::is_directory(path, error)) throw FileError(path.string() + ": cannot read, it is a folder; give an image file");
    if (const std::string fault = not_a_regular_file(path); !fault.empty()) throw FileError(path.string() + ": " + fault);
    check_file_readable(path);
    if (lower_ending(path) == ".pfm") return std::make_unique<PfmFile>(path);
    return open_image(path, least_decoding_memory);
}

bool holds_srgb(const ImageHeader& header)
{
    const std::string space = lower(header.color_space);
    if (header.type == SampleType::real || space == "linear") return false;
    return space == "srgb" || header.type == SampleType::byte;
}

Image read_image_header(const fs::path& path)
{
    return header_of(*open_image_file(path));
}

Image read_image(const fs::path& path)
{
    const auto file = open_image_file(path);
    Image image = header_of(*file);
    const bool encoded = holds_srgb(file->header());
    const auto alpha = find_channel(image.channels, "a");
    // Rows are added as they come: a file may claim more of them than it has.
    for (int y = 0; y < image.height; y++) {
        const std::span<const float> row = file->next_row();
        image.pixels.insert(image.pixels.end(), row.begin(), row.end());
        if (!encoded) continue;
        for (std::size_t i = image.pixels.size() - row.size(); i < image.pixels.size(); i++)
            if (alpha != i % image.channels.size()) image.pixels[i] = linear_from_srgb(image.pixels[i]);
    }
    return image;
}

void check_writable(const fs::path& path)
{
    format_to_write(path);
    check_file_writable(path);
}

} // namespace sundog
