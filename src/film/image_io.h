// Image files. Written whole or not at all; the ending of the name chooses the format:
//   .exr  all channels as 32-bit floats, metadata as string attributes
//   .png  R, G, B as 8-bit sRGB, after the exposure
//   .hdr  R, G, B as Radiance RGBE
//   .pfm  R, G, B as 32-bit floats
// A minimal build (SUNDOG_MINIMAL) knows .pfm only.
#pragma once

#include "film/image.h"

#include <filesystem>
#include <string>

namespace sundog {

// Writes the image; the same image gives the same bytes. `exposure_stops` scales PNG by 2^stops.
// Throws FileError: unknown ending, missing channels, or the disk's reason.
void write_image(const std::filesystem::path& path, const Image& image, float exposure_stops = 0.0f);

// Reads any format that OpenImageIO knows (PFM in a minimal build), as linear values: 8-bit files, and
// others marked as sRGB, are decoded. Attributes named "sundog:..." come back as metadata. Throws FileError.
Image read_image(const std::filesystem::path& path);

// Throws FileError when write_image(path, ...) could not succeed: unknown ending, missing or unwritable
// folder, `path` is a folder. To be called before a render starts.
void check_writable(const std::filesystem::path& path);

// ".exr, .png, .hdr or .pfm": what this build can write.
std::string writable_endings();

} // namespace sundog
