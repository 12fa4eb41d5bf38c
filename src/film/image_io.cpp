#include "film/image_io.h"

#include "base/atomic_file.h"
#include "base/errors.h"
#include "base/readable_file.h"
#include "film/image_codec.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <optional>

namespace sundog {

namespace {

namespace fs = std::filesystem;

struct Ending {
    ImageFormat format;
    const char* text;
};
constexpr std::array<Ending, 4> endings{{{ImageFormat::exr, ".exr"}, {ImageFormat::png, ".png"}, {ImageFormat::hdr, ".hdr"}, {ImageFormat::pfm, ".pfm"}}};

std::string lower_ending(const fs::path& path)
{
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
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
    auto find = [&](const char* name) -> int {
        const auto at = std::find(image.channels.begin(), image.channels.end(), name);
        return at == image.channels.end() ? -1 : static_cast<int>(at - image.channels.begin());
    };
    const RgbChannels rgb{find("R"), find("G"), find("B")};
    if (rgb.r >= 0 && rgb.g >= 0 && rgb.b >= 0) return rgb;
    if (image.channel_count() == 1 || find("Y") >= 0) {
        const int grey = std::max(find("Y"), 0);
        return {grey, grey, grey};
    }
    std::string names;
    for (const std::string& name : image.channels) names += (names.empty() ? "" : " ") + name;
    throw FileError(file.string() + ": has no channels R, G and B, only: " + names);
}

void write_image(const fs::path& path, const Image& image, float exposure_stops)
{
    const ImageFormat format = format_to_write(path);
    const RgbChannels rgb = format == ImageFormat::exr ? RgbChannels{} : rgb_channels(image, path);
    write_file(path, format == ImageFormat::pfm ? encode_pfm(image, rgb) : encode(format, image, rgb, exposure_stops, path));
}

Image read_image(const fs::path& path)
{
    std::error_code error;
    if (!fs::exists(path, error)) throw FileError(path.string() + ": cannot read, there is no such file");
    if (fs::is_directory(path, error)) throw FileError(path.string() + ": cannot read, it is a folder; give an image file");
    check_file_readable(path);
    if (lower_ending(path) != ".pfm") return decode_file(path);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (!file.is_open() || file.bad()) throw FileError(path.string() + ": cannot be read to its end");
    return decode_pfm(bytes, path);
}

void check_writable(const fs::path& path)
{
    format_to_write(path);
    check_file_writable(path);
}

} // namespace sundog
