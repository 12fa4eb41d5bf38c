// Image files as texels.
#pragma once

#include "base/errors.h"
#include "scene/scene.h"

#include <filesystem>

namespace sundog
{

// Images of 8 bits a channel stay so, encoded as they are unless `raw` says that they hold plain numbers; all others
// become linear half floats, or 32-bit ones where a value is beyond what a half float holds. Gray becomes red, green and
// blue; alpha is left out. `replaced` is set where values were not finite: NaN becomes 0, infinity 65504. Throws SceneError at `wanted_at` for an unreadable file; in a minimal
// build, always.
TexelImage load_bitmap(const std::filesystem::path& file, const SourceLocation& wanted_at, bool raw, bool& replaced);

// An environment map: linear 32-bit floats, whatever the file holds; negative and infinite values and NaN become 0, and
// `cleaned` is set. Throws as load_bitmap.
TexelImage load_environment(const std::filesystem::path& file, const SourceLocation& wanted_at, bool& cleaned);

// The bytes of a file that load_bitmap(), or load_environment() for an environment map, reads as the same texels: PNG for 8 bits
// a channel (raw, if linear), EXR for floats. `file` is for messages. Throws FileError; in a minimal build, always.
std::string encode_bitmap(const TexelImage& image, const std::filesystem::path& file);

} // namespace sundog
