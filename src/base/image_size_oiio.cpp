// Sizes of images that libraries decode as a whole, read from the first bytes of their files.
#include "base/errors.h"
#include "base/image_decoders.h"

#include <algorithm>

namespace sundog {

namespace {

// LZW codes of 12 bits, the densest packing of these formats, stand for at most 4094 pixels each.
constexpr std::uint64_t max_packing = 4096;

std::uint64_t big_endian(std::string_view bytes, std::size_t at, std::size_t count)
{
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; i++) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

std::uint64_t little_endian_16(std::string_view bytes, std::size_t at)
{
    return static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at])) | static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + 1])) << 8;
}

// An interlaced one: seven passes over the whole image.
WholeImage png_size(std::string_view start)
{
    if (start.size() < 29 || start[28] == 0) return {};
    constexpr std::uint64_t channels_of_type[] = {1, 0, 3, 4, 2, 0, 4}; // palettes as red, green, blue and alpha
    const auto type = static_cast<unsigned char>(start[25]);
    const std::uint64_t channels = type < std::size(channels_of_type) ? channels_of_type[type] : 4;
    return {big_endian(start, 16, 4), big_endian(start, 20, 4), channels * (start[24] == 16 ? 2 : 1)};
}

// A progressive one: all coefficients are kept, in 16 bits.
WholeImage jpeg_size(std::string_view start)
{
    constexpr unsigned start_of_frame = 0xc0, last_start_of_frame = 0xcf, huffman_tables = 0xc4, arithmetic = 0xcc, reserved = 0xc8;
    for (std::size_t at = 2; at + 10 <= start.size();) {
        const auto marker = static_cast<unsigned char>(start[at + 1]);
        if (start[at] != '\xff') return {};
        if (marker == 0xff) { // padding
            at++;
            continue;
        }
        if (marker >= start_of_frame && marker <= last_start_of_frame && marker != huffman_tables && marker != arithmetic && marker != reserved) {
            const bool progressive = (marker & 3) == 2;
            if (!progressive) return {};
            return {big_endian(start, at + 7, 2), big_endian(start, at + 5, 2), 2 * static_cast<std::uint64_t>(static_cast<unsigned char>(start[at + 9])), false};
        }
        at += 2 + big_endian(start, at + 2, 2);
    }
    return {};
}

// Components are decoded to integers of 32 bits.
WholeImage jpeg2000_size(std::string_view start)
{
    constexpr std::uint64_t bytes_per_pixel = 16;
    const std::size_t box = start.substr(0, 80).find("ihdr");
    if (box != std::string_view::npos && box + 12 <= start.size()) return {big_endian(start, box + 8, 4), big_endian(start, box + 4, 4), bytes_per_pixel, false};
    if (start.size() >= 16 && start.starts_with("\xff\x4f\xff\x51")) return {big_endian(start, 8, 4), big_endian(start, 12, 4), bytes_per_pixel, false};
    return {};
}

} // namespace

WholeImage whole_image(std::string_view start)
{
    if (start.starts_with("\x89PNG\r\n")) return png_size(start);
    if (start.starts_with("GIF8") && start.size() >= 10) return {little_endian_16(start, 6), little_endian_16(start, 8), 4};
    if (start.starts_with("\xff\xd8")) return jpeg_size(start);
    return jpeg2000_size(start);
}

void check_whole_image(const WholeImage& image, std::uint64_t memory, std::uint64_t file_bytes, const std::filesystem::path& file)
{
    const std::string size = std::to_string(image.width) + "x" + std::to_string(image.height);
    if (image.width != 0 && image.height > static_cast<std::uint64_t>(max_image_pixels) / image.width)
        refuse_image(file, "it claims " + size + " pixels; at most 2^28 can be read");
    const std::uint64_t bytes = image.width * image.height * image.bytes_per_pixel; // below 2^28 * 64 * 4
    if (image.packed && bytes / max_packing > file_bytes) refuse_image(file, "it is too short for the " + size + " pixels that it claims");
    const std::uint64_t most = std::max(memory, least_decoding_memory);
    if (bytes > most)
        refuse_image(file, "it can be decoded only as a whole, which takes " + std::to_string(bytes >> 20) + " MB, more than the " + std::to_string(most >> 20) +
                               " MB of --texture-memory: allow more, or save it as a PNG without interlacing");
}

} // namespace sundog
