#include "import/bitmap.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace sundog
{

namespace
{

OIIO::TypeDesc file_type(TexelFormat format)
{
    switch (format) {
    case TexelFormat::srgb8:
    case TexelFormat::linear8:
        return OIIO::TypeDesc::UINT8;
    case TexelFormat::half:
        return OIIO::TypeDesc::HALF;
    case TexelFormat::float32:
        return OIIO::TypeDesc::FLOAT;
    }
    throw std::logic_error("a texel format that cannot be written");
}

// Red, green and blue of all texels.
template <class T> std::vector<T> unpack(const TexelImage& image)
{
    constexpr std::size_t bits = 8 * sizeof(T);
    const std::size_t words = image.words_per_texel();
    std::vector<T> pixels;
    pixels.reserve(3 * image.texels.size() / words);
    for (std::size_t i = 0; i < image.texels.size(); i += words)
        for (std::size_t c = 0; c < 3; c++) pixels.push_back(static_cast<T>(image.texels[i + c * bits / 32] >> (c * bits % 32)));
    return pixels;
}

} // namespace

std::string encode_bitmap(const TexelImage& image, const std::filesystem::path& file)
{
    const OIIO::TypeDesc type = file_type(image.format);
    OIIO::ImageSpec spec(image.width, image.height, 3, type);
    spec.attribute("DateTime", ""); // else OpenImageIO adds the time, and no two files are the same
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create(type == OIIO::TypeDesc::UINT8 ? "png" : "openexr");
    const bool opened = output && output->set_ioproxy(&memory) && output->open(file.filename().string(), spec);
    const auto write = [&](const auto& pixels) { return output->write_image(type, pixels.data()) && output->close(); };
    bool done = opened;
    if (opened && image.format == TexelFormat::float32)
        done = write(unpack<uint>(image));
    else if (opened && image.format == TexelFormat::half)
        done = write(unpack<std::uint16_t>(image));
    else if (opened)
        done = write(unpack<std::uint8_t>(image));
    if (!done) throw FileError(file.string() + ": cannot encode the image: " + (output ? output->geterror() : OIIO::geterror()));
    return {bytes.begin(), bytes.end()};
}

} // namespace sundog
