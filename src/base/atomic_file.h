// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace sundog {

// Writes beside `path`, in the same folder, then renames: `path` never holds a part, and keeps its old
// content when something fails. A symbolic link is followed. Throws FileError (missing folder, no
// permission, full disk, ...); nothing is left behind then.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

// Finds out early what would make write_file_atomically(path) fail: creates an empty file beside `path`
// and removes it. Throws FileError.
void check_file_writable(const std::filesystem::path& path);

} // namespace sundog
