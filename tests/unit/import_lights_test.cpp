// Lights of scene files beyond one colour: projectors, spots with images, spectrum plugins, bright bitmaps; and how strong
// a light with a texture counts.
#include "scene/flat_scene.h"
#include "scene/texel_values.h"
#include "scene_folder.h"
#include "support/light_image.h"
#include "support/scene_builder.h"

#include <gmock/gmock.h>

namespace sundog::testing
{
namespace
{

using ::testing::HasSubstr;
using ::testing::IsEmpty;

Vec3 radiance_of(const std::string& spectrum)
{
    const auto loaded = load_with("<emitter type=\"constant\">" + spectrum + "</emitter>");
    EXPECT_THAT(loaded.warnings, IsEmpty());
    return std::get<ConstantEmitter>(loaded.scene.emitters.at(0).model).radiance;
}

void expect_refusal(const std::string& inside, const std::string& message)
{
    try {
        load_with(inside);
        FAIL() << "no error about " << message;
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr(message));
        EXPECT_THAT(error.what(), HasSubstr("scene.xml:2"));
    }
}

TEST(ImportLights, DaylightIsWhiteOrOfAColour)
{
    EXPECT_EQ(radiance_of(R"(<spectrum type="d65" name="radiance"/>)"), (Vec3{1, 1, 1}));
    EXPECT_EQ(radiance_of(R"(<spectrum type="d65" name="radiance"><float name="scale" value="4"/></spectrum>)"), (Vec3{4, 4, 4}));
    expect_near(
        radiance_of(
            R"(<spectrum type="d65" name="radiance"><rgb name="color" value="0.9, 0.5, 0.1"/><float name="scale" value="2"/></spectrum>)"),
        {1.8f, 1.0f, 0.2f}, 1e-6f);
    expect_near(radiance_of(R"(<spectrum type="srgb" name="radiance"><rgb name="color" value="0.9, 0.5, 0.1"/></spectrum>)"),
                {0.9f, 0.5f, 0.1f}, 1e-6f);
}

// The same spectrum, spelled in four ways.
TEST(ImportLights, IrregularAndRegularSpectra)
{
    const Vec3 pairs = radiance_of(R"(<spectrum name="radiance" value="400:1, 500:3, 600:2, 700:0"/>)");
    EXPECT_EQ(radiance_of(R"(<spectrum type="irregular" name="radiance"><string name="wavelengths" value="400, 500, 600 700"/>
        <string name="values" value="1, 3 2,0"/></spectrum>)"),
              pairs);
    EXPECT_EQ(radiance_of(R"(<spectrum type="regular" name="radiance"><float name="wavelength_min" value="400"/>
        <float name="wavelength_max" value="700"/><string name="values" value="1, 3, 2, 0"/></spectrum>)"),
              pairs);
    const SceneFolder folder;
    folder.write("s.spd", "400 1\n500 3\n600 2\n700 0\n");
    const auto loaded = folder.load(scene_with(R"(<emitter type="constant"><spectrum type="irregular" name="radiance">
        <string name="filename" value="s.spd"/></spectrum></emitter>)"));
    EXPECT_EQ(std::get<ConstantEmitter>(loaded.scene.emitters.at(0).model).radiance, pairs);
    // As a reflectance it is seen under D65.
    const auto surface = load_with(R"(<shape type="sphere"><bsdf type="diffuse"><spectrum type="irregular" name="reflectance">
        <string name="wavelengths" value="300, 900"/><string name="values" value="0.5, 0.5"/></spectrum></bsdf></shape>)");
    expect_near(std::get<DiffuseBsdf>(surface.scene.bsdfs.at(0).model).reflectance.value, {0.5f, 0.5f, 0.5f}, 1e-6f);
}

TEST(ImportLights, WrongSpectraAreRefused)
{
    const auto light = [](const std::string& type, const std::string& inside) {
        return "<emitter type=\"constant\"><spectrum type=\"" + type + "\" name=\"radiance\">" + inside + "</spectrum></emitter>";
    };
    expect_refusal(light("irregular", R"(<string name="wavelengths" value="400, 500"/><string name="values" value="1"/>)"),
                   "as many values as wavelengths");
    expect_refusal(light("irregular", R"(<string name="wavelengths" value="500, 400"/><string name="values" value="1, 1"/>)"),
                   "must increase");
    expect_refusal(light("irregular", R"(<string name="wavelengths" value="400, 500"/>)"), "\"values\"");
    expect_refusal(light("irregular", R"(<string name="wavelengths" value="400, x"/><string name="values" value="1, 1"/>)"),
                   "must be numbers, got 'x'");
    expect_refusal(light("regular", R"(<string name="values" value="1"/>)"), "at least two");
    expect_refusal(light("regular", R"(<string name="values" value="1, -1"/>)"), "negative");
    expect_refusal(light("uniform", ""), "needs a <float name=\"value\">");
    expect_refusal(light("rainbow", ""), "supported are blackbody, d65, irregular, regular, srgb, uniform");
    // The cure that README and docs promise.
    expect_refusal("<shape type=\"sphere\"><emitter type=\"directionalarea\"/></shape>", "behind a hole");
}

TEST(ImportLights, CollimatedBeams)
{
    const auto scene = load_with(R"(<emitter type="collimated"/><emitter type="collimated"><rgb name="power" value="1 2 3"/>
        <transform name="to_world"><scale value="3"/><lookat origin="1 2 3" target="5 2 3" up="0 1 0"/></transform></emitter>)").scene;
    const auto& standard = std::get<CollimatedEmitter>(scene.emitters.at(0).model);
    EXPECT_EQ(standard.position, (Vec3{0, 0, 0}));
    EXPECT_EQ(standard.direction, (Vec3{0, 0, 1}));
    EXPECT_EQ(standard.power, (Vec3{1, 1, 1}));
    const auto& placed = std::get<CollimatedEmitter>(scene.emitters.at(1).model);
    expect_near(placed.position, {1, 2, 3}, 1e-6f);
    expect_near(placed.direction, {1, 0, 0}, 1e-7f);
    EXPECT_EQ(placed.power, (Vec3{1, 2, 3}));
}

#ifndef SUNDOG_MINIMAL
// Two texels: (4, 0.5, 0.25), and one far beyond what half floats hold.
const std::string bright_pfm =
    std::string("PF\n2 1\n-1.0\n") + std::string("\0\0\x80\x40\0\0\0\x3f\0\0\x80\x3e\0\x24\x74\x49\0\x24\x74\x49\0\x24\x74\x49", 24); // 1e6

LoadedScene load_beside_images(const std::string& inside)
{
    const SceneFolder folder;
    folder.write("bright.pfm", bright_pfm);
    folder.write("wide.ppm", "P6\n4 2\n255\n" + std::string(24, '\x80'));
    return folder.load(scene_with(inside));
}

TEST(ImportLights, ProjectorsAndTheirFieldOfView)
{
    const auto loaded = load_beside_images(R"(<emitter type="projector"><float name="scale" value="2"/><float name="fov" value="90"/>
        <texture name="irradiance" type="bitmap"><string name="filename" value="wide.ppm"/></texture>
        <transform name="to_world"><lookat origin="1 2 3" target="1 2 4" up="0 1 0"/></transform></emitter>
        <emitter type="projector"><rgb name="irradiance" value="1 2 3"/><float name="fov" value="90"/></emitter>)");
    const auto& wide = std::get<ProjectorEmitter>(loaded.scene.emitters.at(0).model);
    EXPECT_EQ(wide.texture, 0u);
    EXPECT_FLOAT_EQ(wide.irradiance.x, static_cast<float>(2.0 * std::numbers::pi)); // Mitsuba's is in units of pi
    EXPECT_NEAR(wide.half_width, 1.0f, 1e-6f);
    EXPECT_NEAR(wide.half_height, 0.5f, 1e-6f); // of an image of 4 x 2 texels
    expect_near(wide.position, {1, 2, 3}, 0);
    expect_near(wide.axis_z, {0, 0, 1}, 1e-7f);
    expect_near(wide.axis_y, {0, 1, 0}, 1e-7f);
    const auto& plain = std::get<ProjectorEmitter>(loaded.scene.emitters.at(1).model);
    EXPECT_FALSE(plain.texture);
    EXPECT_NEAR(plain.half_height, 1.0f, 1e-6f);
    expect_refusal("<emitter type=\"projector\"><transform name=\"to_world\"><scale x=\"2\"/></transform></emitter>", "scale evenly");
    expect_refusal("<emitter type=\"projector\"><float name=\"scale\" value=\"-1\"/></emitter>", "'scale' of emitter 'projector' must be between");
}

TEST(ImportLights, SpotsWithAnImage)
{
    const auto loaded = load_beside_images(R"(<emitter type="spot"><rgb name="intensity" value="2 3 4"/>
        <texture name="texture" type="bitmap"><string name="filename" value="wide.ppm"/></texture>
        <transform name="to_world"><lookat origin="0 0 0" target="0 0 5" up="0 1 0"/></transform></emitter>)");
    const auto& spot = std::get<SpotEmitter>(loaded.scene.emitters.at(0).model);
    EXPECT_EQ(spot.texture, 0u);
    EXPECT_EQ(spot.intensity, (Vec3{2, 3, 4}));
    expect_near(spot.axis_y, {0, 1, 0}, 1e-7f);
    EXPECT_NEAR(dot(spot.axis_x, spot.direction), 0.0f, 1e-7f);
    expect_refusal(
        R"(<emitter type="spot"><float name="cutoff_angle" value="100"/><texture name="texture" type="checkerboard"/></emitter>)",
        "below 90");
}

TEST(ImportLights, DaylightOfATexture)
{
    const auto loaded = load_beside_images(R"(<shape type="disk"><emitter type="area"><spectrum type="d65" name="radiance">
        <texture name="color" type="bitmap"><string name="filename" value="wide.ppm"/></texture><float name="scale" value="3"/></spectrum></emitter></shape>)");
    const auto& emitter = loaded.scene.shapes.at(0).emitter;
    ASSERT_TRUE(emitter && emitter->texture);
    EXPECT_EQ(emitter->radiance, (Vec3{3, 3, 3}));
    EXPECT_THAT(loaded.warnings, IsEmpty());
}

TEST(ImportLights, BrightBitmapsAreFloats)
{
    const auto loaded = load_beside_images(R"(<shape type="disk"><emitter type="area"><texture name="radiance" type="bitmap">
        <string name="filename" value="bright.pfm"/></texture></emitter></shape>)");
    EXPECT_THAT(loaded.warnings, IsEmpty());
    const TexelImage& image = *std::get<BitmapTexture>(loaded.scene.textures.at(0).model).image;
    ASSERT_EQ(image.format, TexelFormat::float32);
    EXPECT_EQ(linear_texel(image, 0), (Vec3{4, 0.5f, 0.25f}));
    EXPECT_EQ(linear_texel(image, 1), (Vec3{1e6f, 1e6f, 1e6f}));
}
#endif

// Half as bright, chosen half as often: the mean of each kind of texture counts.
TEST(LightStrength, OfTexturesIsTheirMean)
{
    SceneBuilder builder;
    Scene& scene = builder.scene;
    const auto add = [&](auto model) {
        TextureDescription texture;
        texture.model = model;
        scene.textures.push_back(texture);
        return static_cast<uint>(scene.textures.size() - 1);
    };
    const uint bytes = add(
        BitmapTexture{std::make_shared<const TexelImage>(TexelImage{2, 1, TexelFormat::srgb8, {0x00bc00, 0x000000}})}); // green of 0.503
    const uint plain = add(
        BitmapTexture{std::make_shared<const TexelImage>(TexelImage{1, 2, TexelFormat::linear8, {0x0000ff, 0x000033}})}); // red of 1, 0.2
    const uint half =
        add(BitmapTexture{std::make_shared<const TexelImage>(TexelImage{1, 1, TexelFormat::half, {0x40003c00, 0x4400}})}); // 1, 2, 4
    CheckerboardTexture board;
    board.colors[0] = ColorSource(Vec3{2, 2, 2}, half);
    board.colors[1] = ColorSource(Vec3{1, 1, 1});
    const uint squares = add(board);
    const uint attribute = add(AttributeTexture{"vertex_glow"});
    expect_near(mean_color(scene, bytes, nullptr), {0, 0.2514f, 0}, 1e-3f);
    expect_near(mean_color(scene, plain, nullptr), {0.6f, 0, 0}, 1e-6f);
    expect_near(mean_color(scene, squares, nullptr), {1.5f, 2.5f, 4.5f}, 1e-6f);
    EXPECT_EQ(mean_color(scene, attribute, nullptr), (Vec3{0, 0, 0}));

    TriangleMesh mesh = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.attributes.push_back({"vertex_glow", false, {{3, 0, 0}, {0, 0, 0}, {0, 0, 0}}});
    builder.light(mesh, {2, 2, 2})
        .light(Sphere{{5, 0, 0}}, {1, 1, 1})
        .light(Sphere{{9, 0, 0}}, {1, 1, 1})
        .emitter(PointEmitter{{0, 0, 9}, {1, 1, 1}});
    scene.shapes[0].emitter->texture = attribute;
    scene.shapes[1].emitter->texture = plain;
    const FlatScene flat = flatten_scene(scene);
    ASSERT_EQ(flat.light_strengths.size(), 4u);
    EXPECT_FLOAT_EQ(flat.light_strengths[0], 2.0f);
    EXPECT_FLOAT_EQ(flat.light_strengths[1], 0.6f);
    EXPECT_FLOAT_EQ(flat.light_strengths[2], 1.0f);
    EXPECT_FLOAT_EQ(flat.light_strengths[3], 1.0f);
    EXPECT_NEAR((flat.lights[1].probability - 0.025) / (flat.lights[2].probability - 0.025), 0.6, 1e-3); // but for the floor of 0.1 / 4
}

} // namespace
} // namespace sundog::testing
