// Image files. Written whole or not at all; the ending of the name chooses the format:
//   .exr  all channels as 32-bit floats, metadata as string attributes
//   .png  R, G, B as 8-bit sRGB, after the exposure
//   .hdr  R, G, B as Radiance RGBE
//   .pfm  R, G, B as 32-bit floats
// A minimal build (SUNDOG_MINIMAL) knows .pfm only.
#pragma once

#include "base/image_file.h"
#include "film/image.h"

#include <filesystem>
#include <memory>
#include <string>

namespace sundog {

// Writes the image; the same image gives the same bytes. `exposure_stops` scales PNG by 2^stops.
// Values that are not finite reach no file: infinity becomes the largest number and NaN 0, with a warning.
// Throws FileError: unknown ending, missing channels, or the disk's reason.
void write_image(const std::filesystem::path& path, const Image& image, float exposure_stops = 0.0f);

// An image file row by row, of any format that read_image() knows. Throws FileError.
std::unique_ptr<ImageFile> open_image_file(const std::filesystem::path& path);
// Whether its integers are encoded for a screen.
bool holds_srgb(const ImageHeader& header);

// Size, channels and metadata of a file, without its pixels. Throws FileError.
Image read_image_header(const std::filesystem::path& path);

// Reads any format that OpenImageIO knows (PFM in a minimal build), as linear values: 8-bit files, and
// others marked as sRGB, are decoded. Attributes named "sundog:..." come back as metadata. Throws FileError.
Image read_image(const std::filesystem::path& path);

// Throws FileError when write_image(path, ...) could not succeed: unknown ending, missing or unwritable
// folder, `path` is a folder. To be called before a render starts.
void check_writable(const std::filesystem::path& path);

// ".exr, .png, .hdr or .pfm": what this build can write.
std::string writable_endings();

} // namespace sundog
