// Whether a file can be read.
#pragma once

#include <filesystem>

namespace sundog {

// Throws FileError with the system's reason: no permission, too many links, ... A library that reads the file would say that it
// is no image.
void check_file_readable(const std::filesystem::path& path);

} // namespace sundog
