#include "base/regular_file.h"

namespace sundog
{

std::string not_a_regular_file(const std::filesystem::path& file)
{
    std::error_code failed;
    const auto status = std::filesystem::status(file, failed);
    if (std::filesystem::is_regular_file(status)) return {};
    if (status.type() == std::filesystem::file_type::not_found) return "not found";
    if (status.type() == std::filesystem::file_type::none) return "cannot be looked at: check the permissions of its folder";
    if (std::filesystem::is_directory(status)) return "is a folder, not a file";
    return "is a device or a pipe: only regular files are read";
}

} // namespace sundog
