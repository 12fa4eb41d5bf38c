// Image files as texels.
#pragma once

#include "base/errors.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>

namespace sundog
{

// What is wanted of an image file, and what its numbers mean.
struct BitmapRequest {
    std::filesystem::path file;
    bool raw = false;    // plain numbers; else integers are encoded as sRGB
    double gamma = 0.0;  // above 0: the values are the gamma-th roots of linear ones; -1: sRGB, floats too; 0: as `raw` says
    std::string channel; // gray of this one; empty: its colour (scene/color_channels.h)

    auto operator<=>(const BitmapRequest&) const = default;
};

// Values of a file that no texel can hold.
struct TexelRepairs {
    std::uint64_t nan = 0;
    std::uint64_t infinite = 0;
    std::uint64_t huge = 0;     // beyond largest_texel
    std::uint64_t negative = 0; // only where light is wanted

    bool any() const { return nan + infinite + huge + negative > 0; }
    std::string text() const; // "3 NaN, 2 infinite"
};

// So far from the largest float that texels can be mixed and multiplied.
constexpr float largest_texel = 1e30f;

struct LoadedBitmap {
    TexelImage image;
    int file_width = 0;
    int file_height = 0;
    TexelRepairs repairs;

    bool was_halved() const { return image.width != file_width || image.height != file_height; }
};

// Images of 8 bits a channel stay so, encoded as they are or linear; all others, and those with another gamma, become linear half
// floats, or 32-bit ones where a value is beyond what a half float holds. NaN becomes 0, infinity 65504, what is beyond
// largest_texel that. An image that takes more than `memory` bytes is halved while it is read, again and again. Throws SceneError at
// `wanted_at` for a file that cannot be read or has no such channels; in a minimal build, always.
LoadedBitmap load_bitmap(const BitmapRequest& request, const SourceLocation& wanted_at, std::uint64_t memory);

// An environment map: linear 32-bit floats, whatever the file holds; negative and infinite values and NaN become 0. Else as
// load_bitmap.
LoadedBitmap load_environment(const BitmapRequest& request, const SourceLocation& wanted_at, std::uint64_t memory);

// The bytes of a file that load_bitmap(), or load_environment() for an environment map, reads as the same texels: PNG for 8 bits
// a channel (raw, if linear), EXR for floats. `file` is for messages. Throws FileError; in a minimal build, always.
std::string encode_bitmap(const TexelImage& image, const std::filesystem::path& file);

} // namespace sundog
