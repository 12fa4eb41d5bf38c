// The parts of open_image(): what is known of a file before a library opens it, and decoders beside OpenImageIO's.
#pragma once

#include "base/image_file.h"

#include <string_view>

namespace sundog {

// Throws FileError: FILE: cannot read the image: REASON, in one line.
[[noreturn]] void refuse_image(const std::filesystem::path& file, std::string reason);

// What formats that are decoded as a whole say of their size in their first bytes.
struct WholeImage {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    std::uint64_t bytes_per_pixel = 0; // while it is decoded
    bool packed = true; // whether at most max_packing pixels' bytes can come out of a byte of the file
};

// `start`: the first bytes of a file, its first marker segments if it is a JPEG. Width 0: decoded by rows, or not known.
WholeImage whole_image(std::string_view start);

// Throws FileError where decoding takes more than `memory`, or `file_bytes` are too few.
void check_whole_image(const WholeImage& image, std::uint64_t memory, std::uint64_t file_bytes, const std::filesystem::path& file);

// OpenImageIO multiplies WebP's colours by alpha, in 8 bits, which cannot be undone.
std::unique_ptr<ImageFile> open_webp(const std::filesystem::path& file, std::uint64_t memory);

// OpenEXR files of luminance and subsampled chroma, which OpenImageIO does not read.
std::unique_ptr<ImageFile> open_luminance_chroma(const std::filesystem::path& file);

} // namespace sundog
