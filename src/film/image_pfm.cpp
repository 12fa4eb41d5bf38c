// Portable float map: a header of three lines, then float32 rows from the bottom. "PF" is colour, "Pf"
// grey; a negative scale says little endian.
#include "base/errors.h"
#include "film/image_codec.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

namespace sundog {

namespace {

constexpr int largest_side = 1 << 20;

std::uint32_t swap_bytes(std::uint32_t v) { return v << 24 | (v & 0xff00u) << 8 | (v >> 8 & 0xff00u) | v >> 24; }

// The header's words; leaves `bytes` at the pixels (one white space ends the header).
class Header {
public:
    explicit Header(std::string_view bytes) : rest_(bytes) {}

    std::string_view word()
    {
        constexpr std::string_view space = " \t\r\n";
        rest_.remove_prefix(std::min(rest_.find_first_not_of(space), rest_.size()));
        const std::string_view found = rest_.substr(0, rest_.find_first_of(space));
        rest_.remove_prefix(found.size());
        return found;
    }
    template <class Number> std::optional<Number> number()
    {
        const std::string_view text = word();
        Number value{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
        return value;
    }
    std::string_view pixels() const { return rest_.substr(std::min<std::size_t>(1, rest_.size())); }

private:
    std::string_view rest_;
};

} // namespace

std::string encode_pfm(const Image& image, RgbChannels rgb)
{
    static_assert(std::endian::native == std::endian::little);
    std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", image.width, image.height);
    std::vector<float> row(static_cast<std::size_t>(image.width) * 3);
    for (int y = image.height - 1; y >= 0; --y) {
        float* out = row.data();
        for (int x = 0; x < image.width; ++x) {
            *out++ = image.at(x, y, rgb.r);
            *out++ = image.at(x, y, rgb.g);
            *out++ = image.at(x, y, rgb.b);
        }
        bytes.append(reinterpret_cast<const char*>(row.data()), row.size() * sizeof(float));
    }
    return bytes;
}

Image decode_pfm(std::string_view bytes, const std::filesystem::path& file)
{
    Header header(bytes);
    const std::string_view magic = header.word();
    const auto width = header.number<int>(), height = header.number<int>();
    const auto scale = header.number<float>();
    if ((magic != "PF" && magic != "Pf") || !width || !height || !scale || *width <= 0 || *height <= 0 || *width > largest_side ||
        *height > largest_side || *scale == 0.0f || !std::isfinite(*scale))
        throw FileError(file.string() + ": not a PFM image; its header is broken");

    const std::size_t channels = magic == "PF" ? 3 : 1;
    const std::size_t row = static_cast<std::size_t>(*width) * channels;
    const std::string_view pixels = header.pixels();
    if (pixels.size() < row * sizeof(float) * static_cast<std::size_t>(*height))
        throw FileError(file.string() + ": the PFM image is truncated; render or copy it again");

    Image image(*width, *height, channels == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"});
    for (int y = 0; y < *height; ++y)
        std::memcpy(&image.pixels[static_cast<std::size_t>(*height - 1 - y) * row], pixels.data() + static_cast<std::size_t>(y) * row * sizeof(float),
                    row * sizeof(float));
    if (*scale > 0.0f)
        for (float& value : image.pixels) value = std::bit_cast<float>(swap_bytes(std::bit_cast<std::uint32_t>(value)));
    return image;
}

} // namespace sundog
