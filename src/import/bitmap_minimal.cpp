#include "import/bitmap.h"

namespace sundog
{

std::string encode_bitmap(const TexelImage&, const std::filesystem::path& file)
{
    throw FileError(file.string() + ": this build of Sundog writes no bitmaps; build without SUNDOG_MINIMAL");
}

} // namespace sundog
