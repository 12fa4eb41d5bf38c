// A build without OpenImageIO reads no images but PFM, which is no business of this file.
#include "base/errors.h"
#include "base/image_file.h"

namespace sundog {

std::unique_ptr<ImageFile> open_image(const std::filesystem::path& file, std::uint64_t)
{
    throw FileError(file.string() + ": this build of Sundog reads no such images; build without SUNDOG_MINIMAL");
}

} // namespace sundog
