// Whether a PLY file is whole. Assimp 5.2 reads truncated and inconsistent ones without end, so they must not reach it.
#pragma once

#include <filesystem>
#include <string_view>

namespace sundog
{

// Walks over the whole content. Throws SceneError naming the file (and the line, within the header and in text files)
// for a malformed header, missing vertices or faces, data that ends early, coordinates that are not finite numbers,
// faces of fewer than three vertices, and indices out of range.
void check_ply(const std::filesystem::path& file, std::string_view content);

} // namespace sundog
