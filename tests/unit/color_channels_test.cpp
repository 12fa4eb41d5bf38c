// Channels that are an image's colour are chosen by name, in textures, environments and compared images alike.
#include "scene/color_channels.h"
#include "film/compare.h"
#include "film/image_io.h"
#include "import/bitmap.h"
#include "scene/texel_values.h"
#include "scene_folder.h"

#include <gmock/gmock.h>

namespace sundog::testing
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Names = std::vector<std::string>;

std::string refusal(const Names& names)
{
    try {
        color_channels(names, "a.exr");
    } catch (const FileError& error) {
        return error.what();
    }
    return "no error";
}

TEST(ColorChannels, AreChosenByName)
{
    EXPECT_THAT(color_channels(Names{"R", "G", "B"}, "").index, ElementsAre(0, 1, 2));
    EXPECT_THAT(color_channels(Names{"A", "B", "G", "R"}, "").index, ElementsAre(3, 2, 1));
    EXPECT_THAT(color_channels(Names{"alpha.A", "color.R", "color.G", "color.B"}, "").index, ElementsAre(1, 2, 3));
    EXPECT_THAT(color_channels(Names{"albedo.R", "albedo.G", "albedo.B", "R", "G", "B"}, "").index, ElementsAre(3, 4, 5)) << "the default layer first";
    EXPECT_THAT(color_channels(Names{"View.Combined.R", "View.Combined.G", "View.Combined.B", "View.Depth.Z"}, "").index, ElementsAre(0, 1, 2));
    EXPECT_THAT(color_channels(Names{"blue", "green", "red"}, "").index, ElementsAre(2, 1, 0));
    EXPECT_THAT(color_channels(Names{"A", "Y"}, "").index, ElementsAre(1, 1, 1));
    EXPECT_THAT(color_channels(Names{"height"}, "").index, ElementsAre(0, 0, 0)) << "nothing to choose";
    EXPECT_EQ(color_channels(Names{"X", "Y", "Z"}, "").model, ColorChannels::Model::xyz);
    EXPECT_EQ(color_channels(Names{"BY", "RY", "Y"}, "").model, ColorChannels::Model::luminance_chroma);
}

TEST(ColorChannels, AreNeverGuessed)
{
    EXPECT_THAT(refusal({"N.X", "N.Y", "N.Z", "depth.Z"}), HasSubstr("a.exr: it has no channels that are a colour: give it R G B, Y, or X Y Z; its channels are N.X N.Y N.Z depth.Z"));
    EXPECT_THAT(refusal({"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"}), HasSubstr("several of its layers are colours"));
    EXPECT_THAT(refusal({"R", "G"}), HasSubstr("its channels are R G"));
    EXPECT_THAT(refusal({"u", "v", "w"}), HasSubstr("its channels are u v w"));
}

TEST(ColorChannels, BecomeLinearSrgb)
{
    const Vec3 white = color_channels(Names{"X", "Y", "Z"}, "").color({0.95047f, 1.0f, 1.08883f});
    expect_near(white, {1, 1, 1}, 2e-4f);
    // R = 1.5 Y, B = 0.5 Y, and Y is their luminance.
    const Vec3 chroma = color_channels(Names{"Y", "RY", "BY"}, "").color({0.4f, 0.5f, -0.5f});
    EXPECT_NEAR(chroma.x, 0.6f, 1e-6f);
    EXPECT_NEAR(chroma.z, 0.2f, 1e-6f);
    EXPECT_NEAR(luminance(chroma), 0.4f, 1e-6f);
}

TEST(ColorChannels, AreFoundInTheColoursLayer)
{
    const Names layered{"k.A", "l.R", "l.G", "l.B", "l.A"};
    EXPECT_EQ(find_channel(layered, "g"), 2u);
    EXPECT_EQ(find_channel(layered, "a"), 4u);
    EXPECT_EQ(find_channel(layered, "K.a"), 0u);
    EXPECT_EQ(find_channel(Names{"X", "Y", "Z"}, "y"), 1u);
    EXPECT_EQ(find_channel(Names{"Y"}, "r"), 0u) << "gray";
    EXPECT_EQ(find_channel(Names{"R", "G", "B"}, "a"), std::nullopt);
}

#ifndef SUNDOG_MINIMAL

// An uncompressed OpenEXR file by its own documentation: every channel floats of one value, with a sampling rate.
struct ExrChannel {
    const char* name;
    int sampling;
    float value;
};

template <class Number> void append(std::string& bytes, Number value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string exr(int side, const std::vector<ExrChannel>& channels)
{
    std::string list, header("\x76\x2f\x31\x01\x02\0\0\0", 8);
    for (const ExrChannel& channel : channels) {
        list += std::string(channel.name) + '\0';
        for (const int word : {2, 0, channel.sampling, channel.sampling}) append(list, word);
    }
    list += '\0';
    std::string window, origin, one;
    for (const int word : {0, 0, side - 1, side - 1}) append(window, word);
    for (const float word : {0.0f, 0.0f}) append(origin, word);
    append(one, 1.0f);
    const auto attribute = [&](const std::string& name, const std::string& type, const std::string& data) {
        header += name + '\0' + type + '\0';
        append(header, static_cast<int>(data.size()));
        header += data;
    };
    attribute("channels", "chlist", list);
    attribute("compression", "compression", std::string(1, '\0'));
    attribute("dataWindow", "box2i", window);
    attribute("displayWindow", "box2i", window);
    attribute("lineOrder", "lineOrder", std::string(1, '\0'));
    attribute("pixelAspectRatio", "float", one);
    attribute("screenWindowCenter", "v2f", origin);
    attribute("screenWindowWidth", "float", one);
    header += '\0';
    std::string table, rows;
    for (int y = 0; y < side; y++) {
        std::string row;
        for (const ExrChannel& channel : channels)
            for (int x = 0; x < side && y % channel.sampling == 0; x += channel.sampling) append(row, channel.value);
        append(table, static_cast<std::uint64_t>(header.size() + 8 * static_cast<std::size_t>(side) + rows.size()));
        append(rows, y);
        append(rows, static_cast<int>(row.size()));
        rows += row;
    }
    return header + table + rows;
}

TEST(ColorChannels, TexturesEnvironmentsAndComparedImagesAgree)
{
    const SceneFolder folder;
    folder.write("plain.exr", exr(4, {{"B", 1, 0.25f}, {"G", 1, 0.5f}, {"R", 1, 0.75f}}));
    folder.write("layer.exr", exr(4, {{"alpha.A", 1, 9.0f}, {"color.B", 1, 0.25f}, {"color.G", 1, 0.5f}, {"color.R", 1, 0.75f}}));
    const float y = luminance({0.75f, 0.5f, 0.25f});
    for (const int sampling : {1, 2})
        folder.write("chroma" + std::to_string(sampling) + ".exr",
                     exr(4, {{"BY", sampling, (0.25f - y) / y}, {"RY", sampling, (0.75f - y) / y}, {"Y", 1, y}}));
    for (const char* name : {"plain.exr", "layer.exr", "chroma1.exr", "chroma2.exr"}) {
        SCOPED_TRACE(name);
        const BitmapRequest request{folder.path() / name, false, 0.0, {}};
        expect_near(linear_texel(load_bitmap(request, {}, 1 << 20).image, 5), {0.75f, 0.5f, 0.25f}, 2e-3f);
        expect_near(linear_texel(load_environment(request, {}, 1 << 20).image, 5), {0.75f, 0.5f, 0.25f}, 2e-3f);
        EXPECT_LT(compare_files(folder.path() / name, folder.path() / "plain.exr").rmse, 2e-3);
    }
    folder.write("normals.exr", exr(4, {{"N.X", 1, 0.0f}, {"N.Y", 1, 0.0f}, {"N.Z", 1, 1.0f}}));
    const auto error_of = [](const auto& read) -> std::string {
        try {
            read();
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    const std::string listed = "its channels are N.X N.Y N.Z";
    EXPECT_THAT(error_of([&] { load_bitmap({folder.path() / "normals.exr", false, 0.0, {}}, {"s.xml", 7}, 1 << 20); }), HasSubstr(listed));
    EXPECT_THAT(error_of([&] { load_environment({folder.path() / "normals.exr", false, 0.0, {}}, {"s.xml", 7}, 1 << 20); }), HasSubstr(listed));
    EXPECT_THAT(error_of([&] { compare_files(folder.path() / "normals.exr", folder.path() / "plain.exr"); }), HasSubstr(listed));
}

#endif

} // namespace
} // namespace sundog::testing
