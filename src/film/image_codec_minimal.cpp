// A build without OpenImageIO: PFM only, which image_pfm.cpp reads and writes itself.
#include "base/errors.h"
#include "film/image_codec.h"

namespace sundog {

bool can_encode(ImageFormat) { return false; }

std::string encode(ImageFormat, const Image&, RgbChannels, float, const std::filesystem::path& file)
{
    throw FileError(file.string() + ": this build of Sundog writes .pfm only");
}

} // namespace sundog
