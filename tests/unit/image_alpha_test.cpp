// Alpha of image files: colours are what the file says, whatever alpha is beside them.
#include "import/bitmap.h"
#include "scene/texel_values.h"
#include "scene_folder.h"

#include <gmock/gmock.h>

#ifndef SUNDOG_MINIMAL

#include <OpenImageIO/imageio.h>
#include <webp/encode.h>
#include <zlib.h>

namespace sundog::testing
{
namespace
{

using ::testing::HasSubstr;

constexpr std::array<unsigned char, 4> pixel = {200, 120, 60, 64};

// 2 x 2 pixels, all the same.
void write_pixels(const std::filesystem::path& file, std::vector<unsigned char> samples, std::vector<std::string> channels, OIIO::TypeDesc type = OIIO::TypeDesc::UINT8)
{
    OIIO::ImageSpec spec(2, 2, static_cast<int>(channels.size()), type);
    spec.channelnames = channels;
    spec.alpha_channel = channels.back() == "A" ? static_cast<int>(channels.size()) - 1 : -1;
    spec.attribute("oiio:UnassociatedAlpha", 1);
    const auto output = OIIO::ImageOutput::create(file.string());
    std::vector<unsigned char> all;
    for (int i = 0; i < 4; i++) all.insert(all.end(), samples.begin(), samples.end());
    ASSERT_TRUE(output && output->open(file.string(), spec) && output->write_image(OIIO::TypeDesc::UINT8, all.data()) && output->close()) << file;
}

void append_chunk(std::string& png, const std::string& type, const std::string& data)
{
    const auto number = [&](std::uint32_t value) {
        for (const int shift : {24, 16, 8, 0}) png += static_cast<char>(value >> shift & 0xff);
    };
    const std::string body = type + data;
    number(static_cast<std::uint32_t>(data.size()));
    png += body;
    number(static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()))));
}

std::string deflated(const std::string& bytes)
{
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()));
    packed.resize(size);
    return packed;
}

// One pixel of a palette whose colour has alpha 64.
std::string palette_png()
{
    std::string png("\x89PNG\r\n\x1a\n", 8);
    append_chunk(png, "IHDR", std::string("\0\0\0\1\0\0\0\1\x08\x03\0\0\0", 13));
    append_chunk(png, "PLTE", {static_cast<char>(pixel[0]), static_cast<char>(pixel[1]), static_cast<char>(pixel[2])});
    append_chunk(png, "tRNS", {static_cast<char>(pixel[3])});
    append_chunk(png, "IDAT", deflated(std::string("\0\0", 2)));
    append_chunk(png, "IEND", "");
    return png;
}

std::string webp()
{
    std::uint8_t* bytes = nullptr;
    std::vector<unsigned char> all;
    for (int i = 0; i < 4; i++) all.insert(all.end(), pixel.begin(), pixel.end());
    const std::size_t size = WebPEncodeLosslessRGBA(all.data(), 2, 2, 8, &bytes);
    std::string file(reinterpret_cast<const char*>(bytes), size);
    WebPFree(bytes);
    return file;
}

Vec3 first_texel(const std::filesystem::path& file, const std::string& channel = "")
{
    return linear_texel(load_bitmap({file, false, 0.0, channel}, {"scene.xml", 1}, 1 << 20).image, 0);
}

// The sRGB values (200, 120, 60) by IEC 61966-2-1.
constexpr Vec3 color{0.57758f, 0.18782f, 0.04519f};
constexpr float tolerance = 2e-4f; // of half floats

TEST(ImageAlpha, ColoursAreThoseOfTheFile)
{
    const SceneFolder folder;
    for (const char* name : {"a.png", "a.tga", "a.tif", "a.bmp", "a.sgi"}) write_pixels(folder.path() / name, {pixel.begin(), pixel.end()}, {"R", "G", "B", "A"});
    write_pixels(folder.path() / "a16.png", {pixel.begin(), pixel.end()}, {"R", "G", "B", "A"}, OIIO::TypeDesc::UINT16);
    folder.write("palette.png", palette_png());
    folder.write("a.webp", webp());
    for (const char* name : {"a.png", "a16.png", "a.tga", "a.tif", "a.bmp", "a.sgi", "palette.png", "a.webp"}) {
        SCOPED_TRACE(name);
        expect_near(first_texel(folder.path() / name), color, tolerance);
        const LoadedBitmap environment = load_environment({folder.path() / name, false, 0.0, {}}, {"scene.xml", 1}, 1 << 20);
        expect_near(linear_texel(environment.image, 0), color, tolerance);
        EXPECT_NEAR(first_texel(folder.path() / name, "a").x, 64.0f / 255.0f, 1e-4f) << "alpha is never encoded";
    }
}

TEST(ImageAlpha, GrayIsThatOfTheFile)
{
    const SceneFolder folder;
    for (const char* name : {"g.png", "g.tga", "g.tif"}) {
        SCOPED_TRACE(name);
        write_pixels(folder.path() / name, {pixel[0], pixel[3]}, {"Y", "A"});
        expect_near(first_texel(folder.path() / name), {color.x, color.x, color.x}, tolerance);
        EXPECT_NEAR(first_texel(folder.path() / name, "a").x, 64.0f / 255.0f, 1e-4f);
    }
}

TEST(ImageAlpha, ChannelsAreChosenByName)
{
    const SceneFolder folder;
    write_pixels(folder.path() / "a.png", {pixel.begin(), pixel.end()}, {"R", "G", "B", "A"});
    const auto bitmap = [&](const std::string& channel) {
        return folder.load(scene_with("<shape type=\"sphere\"><bsdf type=\"mask\"><texture name=\"opacity\" type=\"bitmap\"><string name=\"filename\" value=\"a.png\"/>"
                                      "<string name=\"channel\" value=\"" + channel + "\"/></texture><bsdf type=\"diffuse\"/></bsdf></shape>", "0.6.0"));
    };
    const std::pair<const char*, float> wanted[] = {{"r", color.x}, {"g", color.y}, {"b", color.z}, {"a", 64.0f / 255.0f}};
    for (const auto& [channel, value] : wanted) {
        const LoadedScene loaded = bitmap(channel);
        const Vec3 texel = linear_texel(*std::get<BitmapTexture>(loaded.scene.textures.at(0).model).image, 0);
        expect_near(texel, {value, value, value}, tolerance);
        EXPECT_TRUE(loaded.warnings.empty());
    }
    try {
        bitmap("x");
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr("a.png: the image has no channel 'x'; its channels are R G B A"));
        EXPECT_THAT(error.what(), HasSubstr("scene.xml:2: "));
    }
}

} // namespace
} // namespace sundog::testing

#endif
