// Textures of scene files: their plugins, spellings of 0.6 and 3.x, sharing, and what is wrong with them.
#include "scene/texel_values.h"
#include "scene_folder.h"

#include <cmath>
#include <gmock/gmock.h>

#ifndef SUNDOG_MINIMAL

namespace sundog::testing
{
namespace
{

using ::testing::HasSubstr;

// Two texels, red and half gray; P6 is a binary PPM.
const std::string two_texels = std::string("P6\n2 1\n255\n") + "\xff\x10\x20\x80\x80\x80";
const std::string one_float = std::string("PF\n1 1\n-1.0\n") + std::string("\0\0\x80\x40\0\0\0\x3f\0\0\x80\x3e", 12); // 4, 0.5, 0.25

std::string diffuse(const std::string& texture)
{
    return "<shape type=\"sphere\"><bsdf type=\"diffuse\">" + texture + "</bsdf></shape>";
}

LoadedScene load_textured(const std::string& inside, const std::string& version = "3.0.0")
{
    const SceneFolder folder;
    folder.write("a.ppm", two_texels);
    folder.write("b.pfm", one_float);
    return folder.load(scene_with(inside, version));
}

const BitmapTexture& bitmap_of(const LoadedScene& loaded, std::size_t i)
{
    return std::get<BitmapTexture>(loaded.scene.textures.at(i).model);
}

void expect_error(const std::string& inside, const std::string& message)
{
    try {
        load_textured(inside);
        FAIL() << "no error about " << message;
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr(message));
        EXPECT_THAT(error.what(), HasSubstr("scene.xml:"));
    }
}

TEST(ImportTextures, BitmapsKeepTheirBytes)
{
    const auto loaded = load_textured(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="a.ppm"/></texture>)"));
    ASSERT_EQ(loaded.scene.textures.size(), 1u);
    const TexelImage& image = *bitmap_of(loaded, 0).image;
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 1);
    EXPECT_EQ(image.format, TexelFormat::srgb8);
    EXPECT_EQ(image.texels, (std::vector<uint>{0x2010ff, 0x808080}));
    EXPECT_EQ(bitmap_of(loaded, 0).wrap_u, WrapMode::repeat);
    EXPECT_EQ(bitmap_of(loaded, 0).filter, TextureFilter::bilinear);
    const auto& reflectance = std::get<DiffuseBsdf>(loaded.scene.bsdfs[0].model).reflectance;
    EXPECT_EQ(reflectance.texture, 0u);
    EXPECT_EQ(reflectance.value, (Vec3{1, 1, 1}));
    EXPECT_TRUE(loaded.warnings.empty());
}

TEST(ImportTextures, FloatsAreLinearHalves)
{
    const auto loaded = load_textured(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="b.pfm"/></texture>)"));
    const TexelImage& image = *bitmap_of(loaded, 0).image;
    EXPECT_EQ(image.format, TexelFormat::half);
    // 4 = 2^2, 0.5 = 2^-1, 0.25 = 2^-2 with an exponent biased by 15.
    EXPECT_EQ(image.texels, (std::vector<uint>{(17u << 10) | (14u << 10) << 16, 13u << 10}));
}

TEST(ImportTextures, ParametersOf3)
{
    const auto loaded = load_textured(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="a.ppm"/>
        <boolean name="raw" value="true"/><string name="filter_type" value="nearest"/><string name="wrap_mode" value="mirror"/>
        <transform name="to_uv"><scale x="2" y="3"/><translate x="0.5" y="0.25"/></transform></texture>)"));
    EXPECT_EQ(bitmap_of(loaded, 0).image->format, TexelFormat::linear8);
    EXPECT_EQ(bitmap_of(loaded, 0).wrap_u, WrapMode::mirror);
    EXPECT_EQ(bitmap_of(loaded, 0).filter, TextureFilter::nearest);
    EXPECT_EQ(loaded.scene.textures[0].to_u, (std::array<float, 3>{2, 0, 0.5f}));
    EXPECT_EQ(loaded.scene.textures[0].to_v, (std::array<float, 3>{0, 3, 0.25f}));
}

TEST(ImportTextures, ParametersOf06)
{
    const auto loaded = load_textured(diffuse(R"(<texture name="reflectance" type="scale"><float name="scale" value="0.5"/>
        <texture type="bitmap"><string name="filename" value="a.ppm"/><float name="gamma" value="1"/><string name="wrapMode" value="clamp"/>
        <float name="uscale" value="4"/><float name="voffset" value="0.1"/><string name="filterType" value="ewa"/></texture></texture>)"),
                                      "0.6.0");
    EXPECT_EQ(bitmap_of(loaded, 0).image->format, TexelFormat::linear8);
    EXPECT_EQ(bitmap_of(loaded, 0).wrap_u, WrapMode::clamp);
    EXPECT_EQ(loaded.scene.textures[0].to_u, (std::array<float, 3>{4, 0, 0}));
    EXPECT_EQ(loaded.scene.textures[0].to_v, (std::array<float, 3>{0, 1, 0.1f}));
    EXPECT_EQ(std::get<DiffuseBsdf>(loaded.scene.bsdfs[0].model).reflectance.value, (Vec3{0.5f, 0.5f, 0.5f}));
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_THAT(loaded.warnings[0], HasSubstr("'ewa' is done as bilinear"));
}

TEST(ImportTextures, SharedObjectsAndFilesAreReadOnce)
{
    const auto loaded = load_textured(R"(<texture id="t" type="bitmap"><string name="filename" value="a.ppm"/></texture>)" +
                                      diffuse(R"(<ref name="reflectance" id="t"/>)") + diffuse(R"(<ref name="reflectance" id="t"/>)") +
                                      diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="a.ppm"/><string name="wrap_mode" value="clamp"/></texture>)"));
    ASSERT_EQ(loaded.scene.textures.size(), 2u);
    EXPECT_EQ(bitmap_of(loaded, 0).image, bitmap_of(loaded, 1).image);
}

TEST(ImportTextures, CheckerboardsAndAttributes)
{
    const auto loaded = load_textured(diffuse(R"(<texture name="reflectance" type="checkerboard"><rgb name="color0" value="0.1 0.2 0.3"/>
        <texture name="color1" type="mesh_attribute"><string name="name" value="vertex_color"/></texture></texture>)"));
    ASSERT_EQ(loaded.scene.textures.size(), 2u);
    const auto& board = std::get<CheckerboardTexture>(loaded.scene.textures[1].model);
    EXPECT_EQ(board.colors[0].value, (Vec3{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(board.colors[1].texture, 0u);
    EXPECT_EQ(std::get<AttributeTexture>(loaded.scene.textures[0].model).name, "vertex_color");
}

TEST(ImportTextures, NumbersMayBeTextures)
{
    const auto loaded = load_textured(R"(<shape type="sphere"><bsdf type="roughconductor"><texture name="alpha" type="bitmap">
        <string name="filename" value="a.ppm"/><boolean name="raw" value="true"/></texture></bsdf></shape>
        <shape type="sphere"><bsdf type="mask"><float name="opacity" value="0.25"/><bsdf type="diffuse"/></bsdf></shape>)");
    const auto& metal = std::get<ConductorBsdf>(loaded.scene.bsdfs[0].model);
    EXPECT_EQ(metal.roughness->alpha_u.texture, 0u);
    EXPECT_TRUE(metal.roughness->beckmann);
    const auto& mask = std::get<MaskBsdf>(loaded.scene.bsdfs[2].model);
    EXPECT_EQ(mask.opacity.value, 0.25f);
    EXPECT_EQ(mask.nested, 1u);
}

TEST(ImportTextures, UvscaleIsForBothAxes)
{
    const auto loaded = load_textured(diffuse(R"(<texture name="reflectance" type="checkerboard"><float name="uvscale" value="8"/>
        <float name="vscale" value="3"/><string name="coordinates" value="uv"/></texture>)"),
                                      "0.6.0");
    EXPECT_EQ(loaded.scene.textures[0].to_u, (std::array<float, 3>{8, 0, 0}));
    EXPECT_EQ(loaded.scene.textures[0].to_v, (std::array<float, 3>{0, 3, 0}));
    EXPECT_TRUE(loaded.warnings.empty());
}

TEST(ImportTextures, WrapModesOfEachAxis)
{
    const auto modes = [](const std::string& parameters) {
        const auto loaded = load_textured(
            diffuse("<texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" value=\"a.ppm\"/>" + parameters + "</texture>"), "0.6.0");
        EXPECT_TRUE(loaded.warnings.empty());
        return std::pair(bitmap_of(loaded, 0).wrap_u, bitmap_of(loaded, 0).wrap_v);
    };
    EXPECT_EQ(modes(R"(<string name="wrapModeU" value="zero"/><string name="wrapModeV" value="one"/>)"), std::pair(WrapMode::zero, WrapMode::one));
    EXPECT_EQ(modes(R"(<string name="wrapMode" value="mirror"/><string name="wrapModeV" value="clamp"/>)"), std::pair(WrapMode::mirror, WrapMode::clamp));
    EXPECT_EQ(modes(R"(<string name="wrapMode" value="one"/>)"), std::pair(WrapMode::one, WrapMode::one));
}

// The second texel of a.ppm has the value 128.
TEST(ImportTextures, GammaByNumber)
{
    const auto texel = [](const std::string& gamma, const std::string& file, std::size_t i) {
        const auto loaded = load_textured(diffuse("<texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" value=\"" + file +
                                                  "\"/><float name=\"gamma\" value=\"" + gamma + "\"/></texture>"),
                                          "0.6.0");
        return linear_texel(*bitmap_of(loaded, 0).image, i);
    };
    const double encoded = 128.0 / 255.0;
    EXPECT_NEAR(texel("1.8", "a.ppm", 1).x, std::pow(encoded, 1.8), 2e-4);
    EXPECT_NEAR(texel("2.2", "a.ppm", 1).x, std::pow(encoded, 2.2), 2e-4);
    EXPECT_NEAR(texel("1", "a.ppm", 1).x, encoded, 1e-6);
    EXPECT_NEAR(texel("-1", "a.ppm", 1).x, std::pow((encoded + 0.055) / 1.055, 2.4), 1e-6);
    // 0.5 and .25 in a float image, which is linear unless the scene says otherwise.
    EXPECT_NEAR(texel("-1", "b.pfm", 0).y, std::pow((0.5 + 0.055) / 1.055, 2.4), 2e-4);
    EXPECT_NEAR(texel("0", "b.pfm", 0).y, 0.5, 0.0);
}

std::string pfm(const std::vector<float>& values)
{
    std::string file = "PF\n" + std::to_string(values.size() / 3) + " 1\n-1.0\n";
    for (const float value : values) file.append(reinterpret_cast<const char*>(&value), sizeof value);
    return file;
}

TEST(ImportTextures, TexelsOutOfRangeAreCounted)
{
    const SceneFolder folder;
    folder.write("wild.pfm", pfm({-1, 0.5f, 0.5f, 3, 0, 0, 3e38f, 0, 0, NAN, 0, 0}));
    const std::string file = R"(<string name="filename" value="wild.pfm"/>)";
    const auto loaded = folder.load(scene_with(R"(<texture type="bitmap" id="t">)" + file + "</texture>" + diffuse(R"(<ref id="t" name="reflectance"/>)") +
                                               diffuse(R"(<ref id="t" name="reflectance"/>)") +
                                               R"(<shape type="sphere"><emitter type="area"><ref id="t" name="radiance"/></emitter></shape>)"));
    EXPECT_THAT(loaded.warnings, ::testing::ElementsAre(HasSubstr("(1 NaN, 1 beyond 1e30)"),
                                                        HasSubstr("outside of [0, 1], where energy is conserved, and were clamped: 1 of 4 texels are negative, 2 above 1"),
                                                        HasSubstr("below 0 and count as 0: 1 of 4 texels are negative")));
    ASSERT_EQ(loaded.scene.textures.size(), 2u) << "one as a reflectance, one as light";
    EXPECT_EQ(loaded.scene.textures[0].range, TextureRange::unit);
    EXPECT_EQ(loaded.scene.textures[1].range, TextureRange::positive);
    EXPECT_EQ(bitmap_of(loaded, 0).image, bitmap_of(loaded, 1).image);
}

// A factor can bring values back into their range, or out of it.
TEST(ImportTextures, FactorsCountForTheRange)
{
    const auto warnings = [](const std::string& file, const std::string& factor) {
        return load_textured(diffuse("<texture type=\"scale\" name=\"reflectance\"><float name=\"scale\" value=\"" + factor +
                                     "\"/><texture type=\"bitmap\"><string name=\"filename\" value=\"" + file + "\"/></texture></texture>"))
            .warnings;
    };
    EXPECT_TRUE(warnings("b.pfm", "0.25").empty()); // 4, .5, .25
    EXPECT_THAT(warnings("b.pfm", "0.5"), ::testing::ElementsAre(HasSubstr("1 above 1")));
    EXPECT_TRUE(warnings("a.ppm", "1").empty());
    EXPECT_THAT(warnings("a.ppm", "2"), ::testing::ElementsAre(HasSubstr("0 of 2 texels are negative, 1 above 1")));
}

TEST(ImportTextures, EnvironmentsWithoutLightSayWhy)
{
    const SceneFolder folder;
    folder.write("dark.pfm", pfm({-1, -2, NAN, NAN, -1, INFINITY}));
    folder.write("scene.xml", R"(<scene version="3.0.0"><sensor type="perspective"/><shape type="sphere"/>
<emitter type="envmap"><string name="filename" value="dark.pfm"/></emitter></scene>)");
    try {
        load_scene(folder.path() / "scene.xml", {});
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr("scene.xml:2: the scene has no light: this one emits nothing, for its image (or its scale) is nowhere above 0; negative values and NaN count as 0"));
    }
    folder.write("scene.xml", scene_with(R"(<emitter type="envmap"><string name="filename" value="dark.pfm"/></emitter>)"));
    EXPECT_THAT(load_scene(folder.path() / "scene.xml", {}).warnings,
                ::testing::ElementsAre(HasSubstr("are negative or not finite count as 0 (2 NaN, 1 infinite, 3 negative)"), HasSubstr("a light that emits nothing")));
}

TEST(ImportTextures, ColouredOpacityIsSaidToCountByLuminance)
{
    const auto warnings = [](const std::string& version) {
        return load_textured(R"(<shape type="sphere"><bsdf type="mask"><texture name="opacity" type="bitmap"><string name="filename" value="a.ppm"/></texture>
            <bsdf type="diffuse"/></bsdf></shape>)",
                             version)
            .warnings;
    };
    EXPECT_THAT(warnings("0.6.0"), ::testing::ElementsAre(HasSubstr("counts by its luminance, where 0.6 lets each channel through")));
    EXPECT_TRUE(warnings("3.0.0").empty()) << "which takes the luminance itself";
}

TEST(ImportTextures, WhatIsWrongIsSaid)
{
    expect_error(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="none.png"/></texture>)"), "file 'none.png' not found; tried");
    expect_error(diffuse(R"(<texture name="reflectance" type="bitmap"/>)"), "needs a <string name=\"filename\"");
    expect_error(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="scene.xml"/></texture>)"), "cannot read the image");
    expect_error(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="a.ppm"/><string name="wrap_mode" value="zip"/></texture>)"), "repeat, mirror, clamp, zero or one");
    expect_error(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="a.ppm"/><string name="filter_type" value="best"/></texture>)"), "nearest or bilinear");
    expect_error(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="a.ppm"/><float name="gamma" value="-2"/></texture>)"), "'gamma' must be 1 (linear)");
    expect_error(diffuse(R"(<texture name="reflectance" type="checkerboard"><string name="coordinates" value="local"/></texture>)"), "'coordinates' of a texture must be uv");
    expect_error(R"(<texture type="scale" id="t"><ref id="t"/></texture>)" + diffuse(R"(<ref name="reflectance" id="t"/>)"), "this texture contains itself");
    expect_error(R"(<texture type="checkerboard" id="t"><ref id="t" name="color1"/></texture>)" + diffuse(R"(<ref name="reflectance" id="t"/>)"), "this texture contains itself");
    expect_error(diffuse(R"(<texture name="reflectance" type="curvature"/>)"), "texture plugin 'curvature' is not supported; supported are bitmap");
    expect_error(diffuse(R"(<texture name="reflectance" type="scale"/>)"), "needs a <texture> inside");
    expect_error(R"(<shape type="sphere"><bsdf type="roughconductor"><float name="alpha" value="700"/></bsdf></shape>)", "'alpha' must be between 0 and 100, got 700");
    expect_error(R"(<shape type="sphere"><bsdf type="roughconductor"><string name="distribution" value="blinn"/></bsdf></shape>)", "beckmann or ggx");
    expect_error(R"(<bsdf type="mask" id="m"><ref id="m"/></bsdf><shape type="sphere"><ref id="m"/></shape>)", "contains itself");
    expect_error(R"(<shape type="sphere"><bsdf type="blendbsdf"><bsdf type="diffuse"/></bsdf></shape>)", "needs 2 bsdf inside, got 1");
    expect_error(R"(<shape type="sphere"><bsdf type="twosided"><bsdf type="mask"><bsdf type="diffuse"/></bsdf></bsdf></shape>)", "transmits light cannot be twosided");
}

// map_Kd takes the place of Kd; a file that cannot be read leaves it. Two materials share one file's texels.
TEST(ImportTextures, ObjMaterialsHaveImages)
{
    const SceneFolder folder;
    folder.write("a.ppm", two_texels);
    folder.write("m.mtl", "newmtl painted\nKd 0 0 0\nmap_Kd a.ppm\nnewmtl edged\nmap_Kd -clamp on .\\a.ppm\nnewmtl lost\nKd .1 .2 .3\nmap_Kd no.png\n"
                          "newmtl moved\nmap_Kd -s 2 1 1 a.ppm\n");
    folder.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl painted\nf 1/1 2/2 3/3\nusemtl edged\nf 1/1 2/2 3/3\n"
                          "usemtl lost\nf 1/1 2/2 3/3\nusemtl moved\nf 1/1 2/2 3/3\n");
    const auto loaded = folder.load(scene_with(R"(<shape type="obj"><string name="filename" value="m.obj"/></shape>)"));
    const auto reflectance = [&](std::size_t shape) {
        return std::get<DiffuseBsdf>(loaded.scene.bsdfs.at(loaded.scene.shapes.at(shape).bsdf).model).reflectance;
    };
    const auto bitmap = [&](std::size_t shape) { return std::get<BitmapTexture>(loaded.scene.textures.at(reflectance(shape).texture.value()).model); };
    EXPECT_EQ(reflectance(0).value, (Vec3{1, 1, 1}));
    EXPECT_EQ(bitmap(0).wrap_u, WrapMode::repeat);
    EXPECT_EQ(bitmap(1).wrap_v, WrapMode::clamp);
    EXPECT_EQ(bitmap(0).image, bitmap(1).image);
    EXPECT_EQ(bitmap(0).image->width, 2);
    EXPECT_FALSE(reflectance(2).texture);
    EXPECT_EQ(reflectance(2).value, (Vec3{0.1f, 0.2f, 0.3f}));
    EXPECT_THAT(loaded.warnings, ::testing::ElementsAre(HasSubstr("'moved': only its diffuse"), AllOf(HasSubstr("no.png"), HasSubstr("'lost' takes its Kd"))));
}

} // namespace
} // namespace sundog::testing

#endif
