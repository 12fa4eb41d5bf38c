// Images are held to a budget while they are read, and sizes are not believed.
#include "film/compare.h"
#include "import/bitmap.h"
#include "import/texture_budget.h"
#include "scene_folder.h"

#include <gmock/gmock.h>

#ifndef SUNDOG_MINIMAL

#include <OpenImageIO/imageio.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sundog::testing
{
namespace
{

using ::testing::HasSubstr;

std::string big_endian(std::uint32_t value)
{
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 0xff);
    return bytes;
}

// The start of a PNG that claims so many pixels of red, green, blue and alpha; its checksum is not looked at before its size.
std::string png_header(std::uint32_t side, char depth, char interlace)
{
    return std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR", 16) + big_endian(side) + big_endian(side) + depth + '\6' + '\0' + '\0' + interlace;
}

std::string gif(std::uint16_t side)
{
    const std::string size{static_cast<char>(side & 0xff), static_cast<char>(side >> 8), static_cast<char>(side & 0xff), static_cast<char>(side >> 8)};
    return "GIF89a" + size + std::string("\x80\0\0\0\0\0\xff\xff\xff,\0\0\0\0", 14) + size + std::string("\0\2\2\x44\1\0;", 7);
}

std::string refusal(const SceneFolder& folder, const std::string& name)
{
    try {
        load_bitmap({folder.path() / name, false, 0.0, {}}, {"scene.xml", 3}, std::uint64_t{1} << 30);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no error";
}

TEST(ImageMemory, SizesOfHeadersAreNotBelieved)
{
    const SceneFolder folder;
    folder.write("a.gif", gif(65535));
    folder.write("b.gif", gif(16384));
    folder.write("a.png", png_header(65535, 8, 1));
    folder.write("b.png", png_header(16384, 16, 1));
    folder.write("a.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\0\x40\0\x40\x20\0", 18)); // 16384 x 16384
    EXPECT_THAT(refusal(folder, "a.gif"), HasSubstr("scene.xml:3: "));
    EXPECT_THAT(refusal(folder, "a.gif"), HasSubstr("it claims 65535x65535 pixels; at most 2^28 can be read"));
    EXPECT_THAT(refusal(folder, "b.gif"), HasSubstr("it is too short for the 16384x16384 pixels that it claims"));
    EXPECT_THAT(refusal(folder, "a.png"), HasSubstr("it claims 65535x65535 pixels"));
    EXPECT_THAT(refusal(folder, "b.png"), HasSubstr("it is too short"));
    EXPECT_THAT(refusal(folder, "a.tga"), HasSubstr("it is too short"));
    for (const char* name : {"a.gif", "b.gif", "a.png", "b.png", "a.tga"})
        EXPECT_THROW(compare_files(folder.path() / name, folder.path() / name), FileError) << name;
}

TEST(ImageMemory, OnlyRegularFilesAreRead)
{
    const SceneFolder folder;
    ASSERT_EQ(mkfifo((folder.path() / "pipe.png").c_str(), 0600), 0);
    EXPECT_THAT(refusal(folder, "pipe.png"), HasSubstr("only regular files are read"));
    EXPECT_THAT(refusal(folder, "."), HasSubstr("it is a folder"));
}

// Rows that compress well: 64 MB of pixels, 256 MB as floats.
void write_large_png(const std::filesystem::path& file, int side)
{
    OIIO::ImageSpec spec(side, side, 4, OIIO::TypeDesc::UINT8);
    spec.attribute("png:compressionLevel", 1);
    const auto output = OIIO::ImageOutput::create(file.string());
    ASSERT_TRUE(output && output->open(file.string(), spec));
    const std::vector<unsigned char> row(static_cast<std::size_t>(side) * 4, 255);
    for (int y = 0; y < side; y++) ASSERT_TRUE(output->write_scanline(y, 0, OIIO::TypeDesc::UINT8, row.data()));
    ASSERT_TRUE(output->close());
}

#ifndef __SANITIZE_ADDRESS__ // whose own memory counts

// The most that this process has held.
std::uint64_t peak_bytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) << 10;
}

TEST(ImageMemory, LargeImagesAreHalvedWhileTheyAreRead)
{
    const SceneFolder folder;
    constexpr int side = 4096;
    write_large_png(folder.path() / "large.png", side);
    write_large_png(folder.path() / "small.png", 2); // so that libraries are loaded before memory is measured
    const auto load = [&](const char* name) { return load_bitmap({folder.path() / name, false, 0.0, {}}, {}, 1 << 20); };
    load("small.png");
    compare_files(folder.path() / "small.png", folder.path() / "small.png");
    // In a process of its own, for a peak is never forgotten.
    EXPECT_EXIT(
        {
            const std::uint64_t before = peak_bytes();
            const LoadedBitmap bitmap = load("large.png");
            const double difference = compare_files(folder.path() / "large.png", folder.path() / "large.png").mse;
            const bool right = bitmap.image.width == 512 && bitmap.file_width == side && bitmap.image.texels[1000] == 0xffffff && difference == 0.0;
            const bool small = peak_bytes() - before < std::uint64_t{50} << 20;
            _exit(!right ? 1 : !small ? 2 : 0);
        },
        ::testing::ExitedWithCode(0), "");
}

#endif

// The same texels whether the whole image is halved, or its rows as they come.
TEST(ImageMemory, RowsAreHalvedAsImagesAre)
{
    const SceneFolder folder;
    std::string pixels = "P6\n7 5\n255\n";
    for (int i = 0; i < 7 * 5 * 3; i++) pixels += static_cast<char>(i * 83 % 256);
    folder.write("a.ppm", pixels);
    const BitmapRequest request{folder.path() / "a.ppm", false, 0.0, {}};
    const TexelImage whole = load_bitmap(request, {}, 7 * 5 * 4).image;
    EXPECT_EQ(whole.width, 7);
    const TexelImage once = load_bitmap(request, {}, 7 * 5 * 4 - 1).image, twice = load_bitmap(request, {}, 3 * 2 * 4 - 1).image;
    EXPECT_EQ(once.texels, halved(whole).texels);
    EXPECT_EQ(twice.texels, halved(halved(whole)).texels);
    EXPECT_EQ(load_bitmap(request, {}, 0).image.texels.size(), 1u) << "never less than a texel";
}

} // namespace
} // namespace sundog::testing

#endif
