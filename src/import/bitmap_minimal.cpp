#include "import/bitmap.h"

namespace sundog
{

TexelImage load_bitmap(const std::filesystem::path& file, const SourceLocation& wanted_at, bool, bool&)
{
    throw SceneError(wanted_at, "'" + file.string() + "': this build of Sundog reads no bitmaps; build without SUNDOG_MINIMAL");
}

TexelImage load_environment(const std::filesystem::path& file, const SourceLocation& wanted_at, bool& cleaned)
{
    return load_bitmap(file, wanted_at, false, cleaned);
}

std::string encode_bitmap(const TexelImage&, const std::filesystem::path& file)
{
    throw FileError(file.string() + ": this build of Sundog writes no bitmaps; build without SUNDOG_MINIMAL");
}

} // namespace sundog
