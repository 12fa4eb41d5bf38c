// Which files are read: regular ones. A pipe could keep a reader waiting, a device could feed it without end, and both may
// be what somebody else's scene names.
#pragma once

#include <filesystem>
#include <string>

namespace sundog
{

// What is wrong with the file, as the end of a sentence that begins with its name: "is a folder, not a file", "not
// found". Empty for a regular file, whether it can be read or not.
std::string not_a_regular_file(const std::filesystem::path& file);

} // namespace sundog
