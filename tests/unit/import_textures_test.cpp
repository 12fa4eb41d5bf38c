// Textures of scene files: their plugins, spellings of 0.6 and 3.x, sharing, and what is wrong with them.
#include "scene_folder.h"

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
    EXPECT_EQ(bitmap_of(loaded, 0).wrap, WrapMode::repeat);
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
    EXPECT_EQ(bitmap_of(loaded, 0).wrap, WrapMode::mirror);
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
    EXPECT_EQ(bitmap_of(loaded, 0).wrap, WrapMode::clamp);
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

TEST(ImportTextures, WhatIsWrongIsSaid)
{
    expect_error(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="none.png"/></texture>)"), "file 'none.png' not found; tried");
    expect_error(diffuse(R"(<texture name="reflectance" type="bitmap"/>)"), "needs a <string name=\"filename\"");
    expect_error(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="scene.xml"/></texture>)"), "cannot read the image");
    expect_error(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="a.ppm"/><string name="wrap_mode" value="zip"/></texture>)"), "repeat, mirror or clamp");
    expect_error(diffuse(R"(<texture name="reflectance" type="bitmap"><string name="filename" value="a.ppm"/><string name="filter_type" value="best"/></texture>)"), "nearest or bilinear");
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
    EXPECT_EQ(bitmap(0).wrap, WrapMode::repeat);
    EXPECT_EQ(bitmap(1).wrap, WrapMode::clamp);
    EXPECT_EQ(bitmap(0).image, bitmap(1).image);
    EXPECT_EQ(bitmap(0).image->width, 2);
    EXPECT_FALSE(reflectance(2).texture);
    EXPECT_EQ(reflectance(2).value, (Vec3{0.1f, 0.2f, 0.3f}));
    EXPECT_THAT(loaded.warnings, ::testing::ElementsAre(HasSubstr("'moved': only its diffuse"), AllOf(HasSubstr("no.png"), HasSubstr("'lost' takes its Kd"))));
}

} // namespace
} // namespace sundog::testing

#endif
