// Image files: what is written comes back; a failure leaves neither a part nor a temporary file.
#include "base/errors.h"
#include "film/image_io.h"
#include "math/srgb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sundog {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// A folder that goes away with the test.
class ImageFiles : public ::testing::Test {
protected:
    ImageFiles()
    {
        std::string pattern = (fs::temp_directory_path() / "sundog-image-XXXXXX").string();
        folder = ::mkdtemp(pattern.data());
    }
    ~ImageFiles() override
    {
        fs::permissions(folder, fs::perms::owner_all);
        fs::remove_all(folder);
    }

    std::size_t file_count() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator())); }

    static std::string bytes_of(const fs::path& path)
    {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }

    fs::path folder;
};

Image random_image(int width, int height, std::vector<std::string> channels)
{
    Image image(width, height, std::move(channels));
    std::mt19937 random(7);
    std::uniform_real_distribution<float> exponent(-20.0f, 20.0f);
    for (float& value : image.pixels) value = std::exp2(exponent(random));
    return image;
}

// The message of the FileError that `action` throws.
template <class Action> std::string file_error(Action action)
{
    try {
        action();
    } catch (const FileError& error) {
        return error.what();
    }
    ADD_FAILURE() << "no FileError";
    return {};
}

TEST_F(ImageFiles, pfm_keeps_every_bit)
{
    const Image image = random_image(13, 7, {"R", "G", "B"});
    write_image(folder / "a.pfm", image);
    const Image back = read_image(folder / "a.pfm");
    EXPECT_EQ(back.width, 13);
    EXPECT_EQ(back.height, 7);
    EXPECT_EQ(back.channels, image.channels);
    EXPECT_EQ(back.pixels, image.pixels);
}

TEST_F(ImageFiles, pfm_layout_is_the_format_s)
{
    Image image(1, 2, {"B", "G", "R"}); // channels in another order than the file's
    image.pixels = {3, 2, 1, 6, 5, 4}; // top row: R=1 G=2 B=3
    write_image(folder / "a.pfm", image);
    const float rows[] = {4, 5, 6, 1, 2, 3}; // bottom row first
    EXPECT_EQ(bytes_of(folder / "a.pfm"), "PF\n1 2\n-1.0\n" + std::string(reinterpret_cast<const char*>(rows), sizeof rows));
}

TEST_F(ImageFiles, pfm_reads_big_endian_and_grey)
{
    std::string bytes = "Pf\n2 1\n1.0\n";
    for (float value : {0.25f, -7.5f}) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        for (int shift : {24, 16, 8, 0}) bytes += static_cast<char>(bits >> shift & 0xff);
    }
    std::ofstream(folder / "grey.pfm", std::ios::binary) << bytes;
    const Image image = read_image(folder / "grey.pfm");
    EXPECT_THAT(image.pixels, ::testing::ElementsAre(0.25f, -7.5f));
    EXPECT_THAT(image.channels, ::testing::ElementsAre("Y"));
}

TEST_F(ImageFiles, broken_pfm_is_refused)
{
    for (const char* bytes : {"", "PF", "PF\n2 2\n", "P6\n2 2\n255\n", "PF\n-2 2\n-1.0\n", "PF\n0 2\n-1.0\n", "PF\nx 2\n-1.0\n", "PF\n2 2\nnan\n",
                              "PF\n999999999 999999999\n-1.0\n", "PF\n1048576 1048576\n-1.0\nabcd", "PF\n2 2\n-1.0\n12345678901234"}) {
        std::ofstream(folder / "broken.pfm", std::ios::binary) << bytes;
        EXPECT_THAT(file_error([&] { read_image(folder / "broken.pfm"); }), HasSubstr("broken.pfm: ")) << bytes;
    }
}

TEST_F(ImageFiles, missing_files_and_folders_are_named)
{
    EXPECT_THAT(file_error([&] { read_image(folder / "none.pfm"); }), HasSubstr("none.pfm: cannot read, there is no such file"));
    EXPECT_THAT(file_error([&] { read_image(folder); }), HasSubstr("it is a folder"));
    EXPECT_THAT(file_error([&] { check_writable(folder / "no" / "a.pfm"); }), HasSubstr("there is no folder"));
    EXPECT_THAT(file_error([&] { check_writable(folder / "a.xyz"); }), HasSubstr("unknown ending .xyz; use "));
    EXPECT_THAT(file_error([&] { check_writable(folder / "a"); }), HasSubstr("has no ending"));
    fs::create_directory(folder / "b.pfm");
    EXPECT_THAT(file_error([&] { check_writable(folder / "b.pfm"); }), HasSubstr("it is a folder"));
    fs::remove(folder / "b.pfm");
    EXPECT_NO_THROW(check_writable(folder / "a.PFM"));
    EXPECT_EQ(file_count(), 0u) << "checking leaves nothing behind";
}

TEST_F(ImageFiles, a_folder_without_permission_is_refused)
{
    if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_THAT(file_error([&] { check_writable(folder / "a.pfm"); }), HasSubstr("Permission denied"));
}

TEST_F(ImageFiles, an_image_without_colours_is_refused)
{
    EXPECT_THAT(file_error([&] { write_image(folder / "a.pfm", random_image(2, 2, {"N.X", "N.Y"})); }), HasSubstr("its channels are N.X N.Y"));
    EXPECT_EQ(file_count(), 0u);
}

// A file size limit stands in for a full disk: write() fails in the middle either way.
TEST_F(ImageFiles, a_full_disk_keeps_the_old_file_and_leaves_no_part)
{
    const fs::path path = folder / "a.pfm";
    std::ofstream(path) << "old";
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write_image(path, random_image(64, 64, {"R", "G", "B"}));
        } catch (const FileError& error) {
            ::_exit(std::string(error.what()).find("free some space") != std::string::npos ? 42 : 43);
        }
        ::_exit(44);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 42);
    EXPECT_EQ(bytes_of(path), "old");
    EXPECT_EQ(file_count(), 1u);
}

TEST_F(ImageFiles, a_symbolic_link_is_followed)
{
    fs::create_directory(folder / "real");
    fs::create_symlink(folder / "real" / "a.pfm", folder / "link.pfm");
    std::ofstream(folder / "real" / "a.pfm") << "old";
    write_image(folder / "link.pfm", random_image(2, 2, {"R", "G", "B"}));
    EXPECT_TRUE(fs::is_symlink(folder / "link.pfm"));
    EXPECT_EQ(read_image(folder / "real" / "a.pfm").width, 2);
}

TEST(ImageTonemap, srgb_is_its_own_inverse_and_meets_the_standard)
{
    for (int i = 0; i <= 1000; ++i) {
        const float linear = static_cast<float>(i) / 1000.0f;
        EXPECT_NEAR(linear_from_srgb(srgb_from_linear(linear)), linear, 2e-6f);
    }
    EXPECT_NEAR(srgb_from_linear(0.5f), 0.7353569f, 1e-6f); // 1.055 * 0.5^(1/2.4) - 0.055
    EXPECT_NEAR(srgb_from_linear(0.001f), 0.01292f, 1e-7f);
    EXPECT_EQ(srgb8_from_linear(0.0f), 0);
    EXPECT_EQ(srgb8_from_linear(1.0f), 255);
    EXPECT_EQ(srgb8_from_linear(0.5f), 188); // round(255 * 0.73536)
    EXPECT_EQ(srgb8_from_linear(7.0f), 255);
    EXPECT_EQ(srgb8_from_linear(-7.0f), 0);
    EXPECT_EQ(srgb8_from_linear(std::nanf("")), 0);
}

#ifndef SUNDOG_MINIMAL

TEST_F(ImageFiles, exr_keeps_every_channel_and_the_metadata)
{
    Image image = random_image(17, 5, {"R", "G", "B", "variance.R", "variance.G", "variance.B", "N.X", "N.Y", "N.Z", "depth.Z"});
    image.at(3, 2, 6) = -0.5f;
    image.metadata = {{"sundog:method", "sppm"}, {"sundog:seed", "18446744073709551615"}, {"sundog:radius", "0.25"}};
    write_image(folder / "a.exr", image);
    const Image back = read_image(folder / "a.exr");
    ASSERT_EQ(back.channel_count(), image.channel_count());
    for (int channel = 0; channel < image.channel_count(); ++channel) {
        const auto at = std::find(back.channels.begin(), back.channels.end(), image.channels[static_cast<std::size_t>(channel)]);
        ASSERT_NE(at, back.channels.end()) << image.channels[static_cast<std::size_t>(channel)];
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                ASSERT_EQ(back.at(x, y, static_cast<int>(at - back.channels.begin())), image.at(x, y, channel));
    }
    EXPECT_THAT(back.metadata, ::testing::UnorderedElementsAreArray(image.metadata));
}

TEST_F(ImageFiles, every_format_gives_the_same_bytes_twice)
{
    const Image image = random_image(31, 19, {"R", "G", "B", "depth.Z"});
    const char* const endings[] = {".exr", ".png", ".hdr", ".pfm"};
    for (const char* ending : endings) write_image(folder / ("a" + std::string(ending)), image);
    ::usleep(1100 * 1000); // a time stamp in seconds would show
    for (const char* ending : endings) {
        const fs::path a = folder / ("a" + std::string(ending)), b = folder / ("b" + std::string(ending));
        write_image(b, image);
        EXPECT_TRUE(bytes_of(a) == bytes_of(b)) << ending;
        EXPECT_FALSE(bytes_of(a).empty());
    }
    EXPECT_EQ(file_count(), 8u);
}

TEST_F(ImageFiles, png_is_srgb_with_exposure_and_read_back_linear)
{
    Image image(3, 1, {"R", "G", "B"});
    image.pixels = {0.0f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.01f, 0.002f, 40.0f};
    write_image(folder / "a.png", image, -1.0f);
    const Image back = read_image(folder / "a.png");
    ASSERT_EQ(back.pixels.size(), image.pixels.size());
    for (std::size_t i = 0; i < 8; ++i) {
        const float halved = image.pixels[i] / 2;
        // Half a step of 1/255 in the encoded value.
        EXPECT_NEAR(srgb_from_linear(back.pixels[i]), srgb_from_linear(halved), 0.5f / 255.0f + 1e-4f) << i;
    }
    EXPECT_EQ(back.pixels[8], 1.0f);
}

TEST_F(ImageFiles, hdr_is_within_the_format_s_precision)
{
    Image image = random_image(16, 16, {"R", "G", "B"});
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) image.pixels[i + 1] = image.pixels[i + 2] = image.pixels[i]; // grey: one exponent
    write_image(folder / "a.hdr", image);
    const Image back = read_image(folder / "a.hdr");
    for (std::size_t i = 0; i < image.pixels.size(); ++i) EXPECT_NEAR(back.pixels[i] / image.pixels[i], 1.0f, 1.0f / 128.0f);
}

TEST_F(ImageFiles, a_file_that_is_no_image_is_refused)
{
    std::ofstream(folder / "text.exr") << "not an image";
    const std::string message = file_error([&] { read_image(folder / "text.exr"); });
    EXPECT_THAT(message, HasSubstr("text.exr: cannot read the image: "));
    EXPECT_EQ(message.find('\n'), std::string::npos);

    write_image(folder / "whole.exr", random_image(64, 64, {"R", "G", "B"}));
    fs::resize_file(folder / "whole.exr", fs::file_size(folder / "whole.exr") / 2);
    EXPECT_THAT(file_error([&] { read_image(folder / "whole.exr"); }), HasSubstr("whole.exr: cannot read"));
}

#endif

} // namespace
// Nobody writes into it: opening it would wait for ever.
TEST_F(ImageFiles, pipes_are_not_opened)
{
    ASSERT_EQ(::mkfifo((folder / "pipe.pfm").c_str(), 0600), 0);
    EXPECT_THAT(file_error([&] { read_image(folder / "pipe.pfm"); }), HasSubstr("a device or a pipe"));
}

} // namespace sundog
