// A scene that is written and read again is the same, bit for bit: on the device, and in what it asks of a method.
#include "import/number_text.h"
#include "import/scene_writer.h"
#include "import/text_file.h"
#include "scene/fingerprint.h"
#include "scene/flat_scene.h"
#include "support/places.h"
#include "unit/scene_folder.h"

#include <bit>
#include <gmock/gmock.h>
#include <random>

namespace
{

using namespace sundog;
using sundog::testing::SceneFolder;

std::string fingerprint_of(const Scene& scene)
{
    return fingerprint(flatten_scene(scene), make_camera(scene.sensor, scene.film), make_pixel_filter(scene.film.filter));
}

std::map<std::string, std::string> values_of(const IntegratorRequest& request)
{
    std::map<std::string, std::string> values;
    for (const auto& [name, parameter] : request.parameters) values[name] = parameter.value;
    return values;
}

// Returns the XML.
std::string expect_same_after_writing(const Scene& scene)
{
    const SceneFolder folder;
    const std::string xml = write_scene(scene, folder.path() / "dump-files");
    folder.write("dump.xml", xml);
    // Moved as a whole.
    std::filesystem::create_directory(folder.path() / "moved");
    for (const char* part : {"dump.xml", "dump-files"})
        if (std::filesystem::exists(folder.path() / part)) std::filesystem::rename(folder.path() / part, folder.path() / "moved" / part);
    const LoadedScene again = load_scene(folder.path() / "moved" / "dump.xml", {});
    // Texels are written as they are, also those that are clamped when they are looked up.
    EXPECT_THAT(again.warnings, ::testing::Each(::testing::HasSubstr("values of the bitmap are outside of [0, 1]"))) << xml;
    EXPECT_EQ(fingerprint_of(again.scene), fingerprint_of(scene)) << scene.file << "\n" << xml;
    EXPECT_EQ(again.scene.integrator.method, scene.integrator.method);
    EXPECT_EQ(again.scene.integrator.sample_count, scene.integrator.sample_count);
    EXPECT_EQ(again.scene.integrator.seed, scene.integrator.seed);
    EXPECT_EQ(values_of(again.scene.integrator), values_of(scene.integrator));
    return xml;
}

std::string expect_same(const SceneFolder& folder, const std::string& inside, const std::string& version = "3.0.0")
{
    return expect_same_after_writing(folder.load(sundog::testing::scene_with(inside, version)).scene);
}

std::string expect_same(const std::string& inside, const std::string& version = "3.0.0")
{
    return expect_same(SceneFolder(), inside, version);
}

// Transforms whose entries have all of their digits.
const std::string turned =
    R"(<transform name="to_world"><scale value="1.7"/><rotate x="1" y="2" z="-.3" angle="37"/><translate x=".1" y="-2.3" z="7"/></transform>)";
const std::string mirrored = R"(<transform name="to_world"><scale x="-1"/><rotate y="1" angle="12.3"/></transform>)";
const std::string uneven =
    R"(<transform name="to_world"><scale x="3" y=".7" z="1.1"/><rotate x="1" y="2" z="-.3" angle="71"/><translate z="4.4"/></transform>)";

std::string shape(const std::string& type, const std::string& inside)
{
    return "<shape type=\"" + type + "\">" + inside + "</shape>";
}

std::string with_material(const std::string& bsdf)
{
    return shape("rectangle", uneven + bsdf);
}

TEST(SceneWriter, ShippedScenes)
{
    std::size_t scenes = 0;
    for (const char* name : {"gallery", "analytic"})
        for (const auto& entry : std::filesystem::directory_iterator(test::source_folder() / "scenes" / name)) {
            if (entry.path().extension() != ".xml") continue;
            expect_same_after_writing(load_scene(entry.path(), {}).scene);
            scenes++;
        }
    EXPECT_GE(scenes, 11u);
}

TEST(SceneWriter, AnalyticShapes)
{
    const std::string flipped = R"(<boolean name="flip_normals" value="true"/>)";
    for (const std::string& placed : {std::string(), turned, mirrored, flipped, turned + flipped, mirrored + flipped})
        for (const char* type : {"sphere", "disk", "cylinder", "rectangle"}) {
            const std::string xml = expect_same(shape(type, placed));
            EXPECT_THAT(xml, ::testing::HasSubstr("type=\"" + std::string(type) + "\""));
        }
    for (const char* type : {"disk", "rectangle", "cube"}) expect_same(shape(type, uneven));
    expect_same(shape("sphere", R"(<point name="center" x=".3" y="1e-7" z="-9"/><float name="radius" value=".123456789"/>)" + turned));
    for (const char* version : {"3.0.0", "0.6.0"})
        expect_same(
            shape("cylinder",
                  R"(<point name="p0" x=".3" y="1" z="-9"/><point name="p1" x="3" y="2.2" z="-7"/><float name="radius" value=".7"/>)" +
                      turned),
            version);
}

// Numbers without pattern: any rounding that is not undone shows.
TEST(SceneWriter, ManyRandomPoses)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<double> number(-3.0, 3.0);
    const auto n = [&] { return number_text(number(random)); };
    const auto pose = [&](const std::string& scale) {
        return "<transform name=\"to_world\">" + scale + "<rotate x=\"" + n() + "\" y=\"" + n() + "\" z=\"1\" angle=\"" +
               number_text(60.0 * number(random)) + "\"/><translate x=\"" + n() + "\" y=\"" + n() + "\" z=\"" + n() + "\"/></transform>";
    };
    for (int trial = 0; trial < 40; trial++) {
        const std::string scale = "<scale value=\"" + n() + "\"/>",
                          scales = "<scale x=\"" + n() + "\" y=\"" + n() + "\" z=\"" + n() + "\"/>";
        const std::string xml =
            "<scene version=\"3.0.0\"><sensor type=\"" + std::string(trial % 2 ? "perspective" : "orthographic") + "\">" +
            (trial % 2 ? pose("") + "<float name=\"fov\" value=\"" + number_text(60.0 + 15.0 * number(random)) + "\"/>" : pose(scales)) +
            "</sensor>" + shape("sphere", pose(scale) + "<emitter type=\"area\"/>") + shape("cylinder", pose(scale)) +
            shape("disk", pose(scales)) + shape("rectangle", pose(scales)) + "<emitter type=\"spot\">" + pose("") +
            "<float name=\"cutoff_angle\" value=\"" + number_text(40.0 + 10.0 * number(random)) +
            "\"/></emitter><emitter type=\"directional\"><vector name=\"direction\" x=\"" + n() + "\" y=\"" + n() +
            "\" z=\"1\"/></emitter></scene>";
        expect_same_after_writing(SceneFolder().load(xml).scene);
    }
}

TEST(SceneWriter, Meshes)
{
    const SceneFolder folder;
    folder.write("m.obj", "v 0 0 0\nv 1 0 .1\nv 1 1.3 0\nv 0 1 0\nv 5 5 5\nvt .1 .2\nvt .7 .3\nvn 0 .6 .9\nf 1/1/1 2/2/1 3/1/1\nf 1/1/1 "
                          "3/2/1 4/1/1\nf 1 2 2\n");
    folder.write(
        "m.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar r\n"
        "property uchar g\nproperty uchar b\nproperty float heat_0\nelement face 2\nproperty list uchar int vertex_indices\n"
        "property float lit_x\nproperty float lit_y\nproperty float lit_z\nend_header\n0 0 0 255 3 77 .1\n1 0 0 1 2 3 .2\n1 1 .2 9 9 9 .3\n"
        "0 1 0 0 0 1 -0\n3 0 1 2 .1 .2 .3\n3 0 2 3 .7 .8 .9\n");
    for (const char* file : {"m.obj", "m.ply"})
        for (const std::string& placed : {std::string(), turned, mirrored, uneven})
            for (const char* extra : {"", R"(<boolean name="face_normals" value="true"/>)",
                                      R"(<float name="max_smooth_angle" value="30"/>)", R"(<boolean name="flip_normals" value="true"/>)"}) {
                std::string inside =
                    "<string name=\"filename\" value=\"" + std::string(file) + "\"/>" + placed + extra + "<bsdf type=\"diffuse\">";
                inside += "<texture name=\"reflectance\" type=\"checkerboard\"><texture name=\"color0\" type=\"mesh_attribute\"><string "
                          "name=\"name\" value=\"face_lit\"/><float name=\"scale\" value=\".3\"/></texture><texture name=\"color1\" "
                          "type=\"checkerboard\"><texture name=\"color0\" type=\"mesh_attribute\"><string name=\"name\" "
                          "value=\"vertex_heat\"/></texture><texture name=\"color1\" type=\"mesh_attribute\"><string name=\"name\" "
                          "value=\"vertex_color\"/></texture></texture></texture></bsdf>";
                expect_same(folder, shape(std::string(file).substr(2), inside));
            }
}

TEST(SceneWriter, SharedAndNestedMaterials)
{
    expect_same(with_material("<ref id=\"a\"/>") + with_material("<ref id=\"b\"/>") + with_material("<ref id=\"a\"/>") + with_material("") +
                R"(<bsdf type="twosided" id="a"><ref id="b"/><bsdf type="roughconductor" id="c"><string name="material" value="Au"/>
<float name="alpha_u" value=".3"/><float name="alpha_v" value=".07"/></bsdf></bsdf>
<bsdf type="blendbsdf" id="b"><ref id="c"/><bsdf type="diffuse"><rgb name="reflectance" value=".1, .2, .3"/></bsdf></bsdf>)");
    for (
        const char* bsdf :
        {R"(<bsdf type="dielectric"><string name="int_ior" value="water"/></bsdf>)", R"(<bsdf type="thindielectric"/>)",
         R"(<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha" value=".21"/></bsdf>)",
         R"(<bsdf type="conductor"><rgb name="eta" value=".2, .9, 1.1"/><rgb name="k" value="3.9, 2.4, 2.2"/><float name="ext_eta" value="1.33"/></bsdf>)",
         R"(<bsdf type="plastic"><float name="int_ior" value="1.9"/><boolean name="nonlinear" value="true"/></bsdf>)",
         R"(<bsdf type="roughplastic"><float name="alpha" value=".3"/><rgb name="specular_reflectance" value=".1, .2, .3"/></bsdf>)",
         R"(<bsdf type="principled"/>)", R"(<bsdf type="principled"><float name="specular" value=".37"/><float name="spec_trans" value=".3"/></bsdf>)",
         R"(<bsdf type="principled"><rgb name="base_color" value=".1, .2, .3"/><float name="roughness" value=".21"/><float name="anisotropic" value=".22"/>
<float name="metallic" value=".23"/><float name="spec_trans" value=".24"/><float name="spec_tint" value=".25"/><float name="sheen" value=".26"/>
<float name="sheen_tint" value=".27"/><float name="flatness" value=".28"/><float name="clearcoat" value=".29"/>
<float name="clearcoat_gloss" value=".31"/><float name="eta" value=".7"/></bsdf>)",
         R"(<bsdf type="principled"><texture name="clearcoat" type="checkerboard"/><texture name="roughness" type="checkerboard">
<rgb name="color0" value=".7"/></texture><texture name="base_color" type="checkerboard"><rgb name="color1" value=".3, .2, .1"/></texture></bsdf>)",
         R"(<bsdf type="phong"><rgb name="specular_reflectance" value=".1, .2, .3"/><float name="exponent" value="12.3"/></bsdf>)",
         R"(<bsdf type="phong"><texture name="exponent" type="checkerboard"/><texture name="diffuse_reflectance" type="checkerboard"/></bsdf>)",
         R"(<bsdf type="mixturebsdf"><string name="weights" value=".2, .3, .4"/><bsdf type="diffuse"/><bsdf type="plastic"/><bsdf type="null"/></bsdf>)",
         R"(<bsdf type="bumpmap"><float name="scale" value="-.3"/><texture name="t" type="checkerboard"/><bsdf type="diffuse"/></bsdf>)",
         R"(<bsdf type="normalmap"><boolean name="use_shadowing_function" value="false"/><texture name="t" type="checkerboard"/><bsdf type="diffuse"/></bsdf>)",
         R"(<bsdf type="null"/>)", R"(<bsdf type="mask"><float name="opacity" value=".3"/><bsdf type="diffuse"/></bsdf>)",
         R"(<bsdf type="diffuse"><spectrum name="reflectance" value="400:.1, 700:.9"/></bsdf>)"})
        expect_same(with_material(bsdf));
}

TEST(SceneWriter, Textures)
{
    const std::string checkers = R"(type="checkerboard"><rgb name="color0" value=".9, .8, .7"/>
<transform name="to_uv"><scale x="4" y="3.3"/><rotate z="1" angle="20"/></transform></texture>)";
    expect_same(with_material("<bsdf type=\"diffuse\"><texture name=\"reflectance\" " + checkers + "</bsdf>"));
    expect_same(with_material("<bsdf type=\"mask\"><texture name=\"opacity\" " + checkers + "<bsdf type=\"diffuse\"/></bsdf>"));
    // Factors of colours and of numbers, whose luminance must come back.
    for (const char* factor : {".3", ".7, .2, .1", "3.7", "0, 0, .9", "0"}) {
        const std::string scaled =
            "type=\"scale\"><rgb name=\"scale\" value=\"" + std::string(factor) + "\"/><texture " + checkers + "</texture>";
        expect_same(with_material("<bsdf type=\"blendbsdf\"><texture name=\"weight\" " + scaled +
                                  "<bsdf type=\"diffuse\"><texture name=\"reflectance\" " + scaled +
                                  "</bsdf><bsdf type=\"diffuse\"/></bsdf>"));
    }
    // 0.6's scale of zero.
    expect_same(with_material(R"(<bsdf type="diffuse"><texture name="reflectance" type="checkerboard"><float name="uscale" value="0"/>
<float name="uoffset" value=".3"/><float name="vscale" value="2"/></texture></bsdf>)"),
                "0.6.0");
}

#ifndef SUNDOG_MINIMAL
TEST(SceneWriter, Bitmaps)
{
    const SceneFolder folder;
    folder.write("b.ppm", "P3\n3 2\n255\n1 2 3 40 50 60 255 0 9\n7 8 9 100 110 120 33 22 11\n");
    folder.write("f.pfm",
                 std::string("PF\n2 1\n-1.0\n") +
                     std::string("\x00\x00\x80\x3f\x00\x00\x00\x3f\xcd\xcc\xcc\x3d\x00\x00\x20\x41\x00\x00\x80\x3e\x17\xb7\xd1\x38", 24));
    const auto bitmap = [](const std::string& file, const std::string& extra) {
        return "<texture type=\"bitmap\" name=\"reflectance\"><string name=\"filename\" value=\"" + file + "\"/>" + extra + "</texture>";
    };
    std::string all;
    for (const char* file : {"b.ppm", "f.pfm"})
        for (const char* extra : {"", R"(<boolean name="raw" value="true"/>)", R"(<string name="wrap_mode" value="mirror"/>)",
                                  R"(<string name="wrap_mode" value="clamp"/><string name="filter_type" value="nearest"/>)"})
            all += with_material("<bsdf type=\"diffuse\">" + bitmap(file, extra) + "</bsdf>");
    const std::string xml = expect_same(folder, all);
    EXPECT_THAT(xml, ::testing::HasSubstr(".png"));
    EXPECT_THAT(xml, ::testing::HasSubstr(".exr"));
    EXPECT_THAT(xml, ::testing::Not(::testing::HasSubstr("image-4"))) << "an image that several textures share is written once";
}

std::string pfm_of(int width, int height, const std::vector<float>& values)
{
    std::string file = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
    for (const float value : values) file.append(reinterpret_cast<const char*>(&value), sizeof value);
    return file;
}

// Floats hold what is beyond a half float; the means of four texels may be within.
TEST(SceneWriter, BitmapsThatWereScaledDown)
{
    const SceneFolder folder;
    std::vector<float> bright, huge;
    for (int i = 0; i < 12; i++) {
        bright.push_back(i < 3 ? 100000.0f : 0.3f * static_cast<float>(i));
        huge.push_back(3e38f); // which four times is beyond a float
    }
    folder.write("bright.pfm", pfm_of(2, 2, bright));
    folder.write("huge.pfm", pfm_of(2, 2, huge));
    std::string all;
    for (const char* file : {"bright.pfm", "huge.pfm"})
        all += with_material(R"(<bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value=")" +
                             std::string(file) + "\"/></texture></bsdf>");
    LoadOptions options;
    options.texture_bytes = 1;
    const Scene scene = folder.load(sundog::testing::scene_with(all), options).scene;
    const auto format = [&](std::size_t texture) { return std::get<BitmapTexture>(scene.textures.at(texture).model).image->format; };
    EXPECT_EQ(format(0), TexelFormat::half);
    EXPECT_EQ(format(1), TexelFormat::float32);
    expect_same_after_writing(scene);
}

TEST(SceneWriter, EnvironmentMaps)
{
    const SceneFolder folder;
    folder.write("b.ppm", "P3\n3 2\n255\n1 2 3 40 50 60 255 0 9\n7 8 9 100 110 120 33 22 11\n");
    folder.write("f.pfm",
                 std::string("PF\n2 1\n-1.0\n") +
                     std::string("\x00\x00\x80\x3f\x00\x00\x00\x3f\xcd\xcc\xcc\x3d\x00\x00\x20\x41\x00\x00\x80\x3e\x17\xb7\xd1\x38", 24));
    for (const char* file : {"b.ppm", "f.pfm"})
        for (const std::string& placed : {std::string(), turned, mirrored}) {
            const std::string xml = expect_same(folder, "<emitter type=\"envmap\"><string name=\"filename\" value=\"" + std::string(file) +
                                                            "\"/><float name=\"scale\" value=\".37\"/>" + placed + "</emitter>");
            EXPECT_THAT(xml, ::testing::HasSubstr(".exr"));
        }
}

TEST(SceneWriter, SunAndSky)
{
    for (const std::string& placed : {std::string(), mirrored}) {
        for (const char* type : {"sunsky", "sky", "sun"})
            for (const char* version : {"3.0.0", "0.6.0"})
                expect_same("<emitter type=\"" + std::string(type) + R"(">
                             <float name="turbidity" value="3.3"/><rgb name="albedo" value=".12, .23, .34"/></emitter>)", version);
        expect_same(R"(<emitter type="sunsky"><vector name="sunDirection" x=".3" y=".4" z=".5"/><float name="stretch" value="1.17"/>
                       <boolean name="extend" value="true"/><float name="sunRadiusScale" value="3.3"/><float name="skyScale" value=".7"/>)" + placed + "</emitter>");
    }
    expect_same(R"(<emitter type="sunsky"><float name="sun_aperture" value="1.23"/><boolean name="complex_sun" value="false"/></emitter>)");
}

TEST(SceneWriter, Coatings)
{
    for (const char* type : {"coating", "roughcoating"})
        expect_same(shape("sphere", "<bsdf type=\"" + std::string(type) + R"("><float name="int_ior" value="1.33"/><float name="thickness" value=".7"/>
            <rgb name="sigma_a" value=".1, .2, 1.3"/><rgb name="specular_reflectance" value=".9, .8, .7"/>
            <bsdf type="blendbsdf"><float name="weight" value=".3"/><bsdf type="diffuse"/><bsdf type="roughconductor"/></bsdf></bsdf>)"));
    expect_same(shape("sphere", R"(<bsdf type="roughcoating"><float name="alpha" value=".23"/><string name="distribution" value="ggx"/>
        <texture name="sigma_a" type="checkerboard"/><bsdf type="phong"/></bsdf>)"));
}

TEST(SceneWriter, ProjectorsOfImages)
{
    const SceneFolder folder;
    folder.write("b.ppm", "P3\n3 2\n255\n1 2 3 40 50 60 255 0 9\n7 8 9 100 110 120 33 22 11\n");
    const std::string image = R"(<texture name="irradiance" type="bitmap"><string name="filename" value="b.ppm"/></texture>)";
    for (const std::string& placed : {std::string(), turned, mirrored})
        for (const char* angle : {"", R"(<float name="fov" value="33.3"/>)", R"(<float name="fov" value="71"/><string name="fov_axis" value="y"/>)",
                                  R"(<float name="fov" value="179.9"/>)", R"(<string name="focal_length" value="35mm"/>)"})
            expect_same(folder, "<emitter type=\"projector\">" + placed + image + angle + "<float name=\"scale\" value=\"7.3\"/></emitter>");
}

// Scaled down from 5 x 2 to 2 x 1 texels, the image would give the projector another height.
TEST(SceneWriter, RefusesProjectorsOfImagesOfAnotherAspect)
{
    const SceneFolder folder;
    folder.write("b.ppm", "P3\n5 2\n255\n1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 1 2 3 4 5 6 7 8 9 1 2 3 4 5 6\n");
    folder.write("scene.xml", sundog::testing::scene_with(R"(<emitter type="projector"><texture name="irradiance" type="bitmap">
<string name="filename" value="b.ppm"/></texture></emitter>)"));
    LoadOptions options;
    options.texture_bytes = 16;
    const Scene scene = load_scene(folder.path() / "scene.xml", options).scene;
    EXPECT_THROW(write_scene(scene, folder.path() / "files"), SceneError);
}
#endif

TEST(SceneWriter, LightsOfTheScene)
{
    expect_same(R"(<emitter type="point"><point name="position" x=".1" y="-0" z="3"/><rgb name="intensity" value="1, 2, .3"/></emitter>
<emitter type="constant"><blackbody name="radiance" temperature="5000K" scale="1e-9"/></emitter>
<emitter type="spot"><transform name="to_world"><lookat origin="1, 2, 3" target=".2, .3, .4"/></transform><float name="cutoff_angle" value="33.3"/>
<float name="beam_width" value="33.3"/></emitter><emitter type="directional"><vector name="direction" x="1" y="2" z=".3"/></emitter>
<emitter type="directional"><transform name="to_world"><rotate x="1" angle="33"/></transform></emitter>
<emitter type="collimated"><transform name="to_world"><lookat origin="1, 2, 3" target=".2, .3, .4"/></transform><rgb name="power" value=".1, 2, 3"/></emitter>)");
}

const std::string checkers = R"(type="checkerboard"><rgb name="color0" value=".9, .8, .7"/></texture>)";

TEST(SceneWriter, TexturedLights)
{
    const auto scaled = [](const std::string& name) {
        return "<texture name=\"" + name + "\" type=\"scale\"><rgb name=\"scale\" value=\"3, .7, .1\"/><texture " + checkers + "</texture>";
    };
    const std::string glow = "<emitter type=\"area\">" + scaled("radiance") + "</emitter>";
    // A light's texture is numbered before those of its shape's material, even where it is the second in the file.
    const std::string material = "<bsdf type=\"diffuse\"><texture name=\"reflectance\" " + checkers + "</bsdf>";
    for (const char* type : {"rectangle", "sphere", "cube"}) {
        expect_same(shape(type, turned + glow + material));
        expect_same(shape(type, turned + material + glow));
    }
    for (const std::string& placed : {std::string(), turned, mirrored}) {
        expect_same("<emitter type=\"spot\">" + placed + scaled("texture") + R"(<rgb name="intensity" value="1, 2, .3"/></emitter>)");
        for (const std::string& irradiance :
             {std::string(), std::string(R"(<rgb name="irradiance" value=".3, 1.7, 2"/>)"), scaled("irradiance"), "<texture name=\"irradiance\" " + checkers})
            expect_same("<emitter type=\"projector\">" + placed + irradiance + R"(<float name="scale" value="1.3"/></emitter>)");
    }
}

TEST(SceneWriter, RefusesTexturesOfLightsThatWereLeftOut)
{
    const Scene scene = SceneFolder()
                            .load(sundog::testing::scene_with(shape("disk", "<emitter type=\"area\"><texture type=\"scale\" name=\"radiance\"><rgb "
                                                                            "name=\"scale\" value=\"0\"/><texture " +
                                                                                checkers + "</texture></emitter>")))
                            .scene;
    const SceneFolder folder;
    EXPECT_THROW(write_scene(scene, folder.path() / "files"), SceneError);
}

// Groups, instances, shapes, BSDFs and textures are numbered as they were, whatever their order in the file.
TEST(SceneWriter, GroupsAndInstances)
{
    const auto instance = [](const std::string& group, const std::string& placed) {
        return shape("instance", "<ref id=\"" + group + "\"/>" + placed);
    };
    const auto textured = [](const std::string& type) {
        return shape(type, uneven + "<bsdf type=\"diffuse\"><texture name=\"reflectance\" " + checkers + "</bsdf>");
    };
    const std::string groups = R"(<shape type="shapegroup" id="a">)" + shape("sphere", turned + "<ref id=\"shared\"/>") + textured("cube") +
                               R"(</shape><shape type="shapegroup" id="b">)" + shape("cylinder", mirrored) + shape("disk", "<ref id=\"shared\"/>") +
                               textured("rectangle") + R"(</shape><bsdf type="dielectric" id="shared"/>)";
    const std::string used = shape("disk", "") + instance("b", uneven) + instance("b", turned) + textured("disk") + instance("a", mirrored) +
                             instance("b", mirrored) + shape("sphere", turned) + instance("a", "");
    for (const std::string& inside : {groups + used, used + groups}) {
        const std::string xml = expect_same(inside);
        EXPECT_THAT(xml, ::testing::HasSubstr("shapegroup"));
    }
    // Nothing but copies, of the later group first.
    expect_same(groups + instance("b", turned) + instance("a", uneven));
}

std::string scene_of_sensor(const std::string& sensor, const std::string& version = "3.0.0")
{
    return "<scene version=\"" + version + "\">" + sensor + "<shape type=\"rectangle\"><emitter type=\"area\"/></shape></scene>";
}

TEST(SceneWriter, Sensors)
{
    const std::string at = R"(<transform name="to_world"><lookat origin="1, 2, 3" target=".2, .3, .4" up="0, 1, .1"/></transform>)";
    const std::string wide = R"(<transform name="to_world"><scale x="3.3" y="2.1" z="1.7"/><rotate x="1" y=".3" angle="41"/></transform>)";
    const std::string clip = R"(<float name="near_clip" value=".37"/><float name="far_clip" value="61.7"/>)";
    const std::string lens = R"(<float name="aperture_radius" value=".13"/><float name="focus_distance" value="4.7"/>)";
    const SceneFolder folder;
    for (const char* version : {"3.0.0", "0.6.0"})
        for (const std::string& sensor :
             {"\"perspective\">" + at + clip, "\"perspective\"><float name=\"fov\" value=\"179.99999\"/>" + mirrored,
              "\"perspective\"><string name=\"focal_length\" value=\"35mm\"/><float name=\"principal_point_offset_x\" value=\".13\"/>" + at,
              "\"thinlens\">" + at + lens, "\"thinlens\"><float name=\"aperture_radius\" value=\".1\"/>" + clip,
              "\"orthographic\">" + wide + clip, "\"orthographic\">" + at, "\"telecentric\">" + wide + lens + clip})
            expect_same_after_writing(folder.load(scene_of_sensor("<sensor type=" + sensor + "</sensor>", version)).scene);
}

// Keys, times and the shutter come back, to the last bit, of shapes, instances and cameras.
TEST(SceneWriter, Motion)
{
    const std::string shutter = R"(<float name="shutter_open" value=".1"/><float name="shutter_close" value="1.7"/>)";
    const auto keys = [](const std::string& scale) {
        return "<animation name=\"to_world\"><transform time=\".3\"><scale " + scale +
               "/><rotate x=\"1\" y=\".3\" angle=\"41\"/></transform>" + "<transform time=\"1.123456789\"><scale " + scale +
               "/><rotate z=\"1\" y=\".7\" angle=\"55\"/><translate x=\".7\"/></transform>" + "<transform time=\"9\"><scale " + scale +
               "/><translate x=\".1\"/></transform></animation>";
    };
    const SceneFolder folder;
    folder.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 .1\nv 1 1.3 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n");
    folder.write("m.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n");
    const std::string shapes = shape("sphere", turned) + shape("cube", keys("x=\"-1\" y=\".7\"")) + shape("disk", "") +
                               shape("obj", R"(<string name="filename" value="m.obj"/>)" + keys("value=\"1.3\"")) +
                               R"(<shape type="shapegroup" id="g">)" + shape("cube", uneven) + "</shape>" +
                               shape("instance", "<ref id=\"g\"/>" + keys("x=\"2\"")) + shape("instance", "<ref id=\"g\"/>" + turned) +
                               shape("sphere", keys("value=\"1\""));
    for (const std::string& sensor :
         {"\"perspective\">" + keys("value=\"1\""), "\"thinlens\"><float name=\"aperture_radius\" value=\".1\"/>" + keys("x=\"-1\""),
          "\"orthographic\">" + keys("x=\"3.3\" y=\"2.1\" z=\"1.7\""), std::string("\"perspective\">")}) {
        const std::string xml = "<scene version=\"3.0.0\"><sensor type=" + sensor + shutter + "</sensor>" + shapes +
                                "<shape type=\"rectangle\"><emitter type=\"area\"/></shape></scene>";
        const Scene scene = folder.load(xml).scene;
        EXPECT_EQ(flatten_scene(scene).instance_motions.size(), 4u);
        EXPECT_THAT(expect_same_after_writing(scene), ::testing::HasSubstr("animation"));
    }
}

TEST(SceneWriter, FilmsSamplersAndMethods)
{
    const SceneFolder folder;
    for (const char* filter :
         {R"("box"/>)", R"("box"><float name="radius" value=".7"/></rfilter>)", R"("tent"><float name="radius" value="1.3"/></rfilter>)",
          R"("gaussian"><float name="stddev" value=".31"/></rfilter>)", R"("mitchell"><float name="b" value=".2"/></rfilter>)",
          R"("catmullrom"/>)"})
        expect_same_after_writing(
            folder
                .load(scene_of_sensor(
                    std::string(R"(<default name="count" value="1000000"/><integrator type="sppm"><integer name="photons" value="$count"/>
<float name="radius" value=".01"/><boolean name="glossy" value="true"/><string name="mode" value="a b"/><integer name="big" value="-1"/></integrator>
<sensor type="perspective"><sampler type="independent"><integer name="sample_count" value="17"/><integer name="seed" value="2147483647"/></sampler>
<film type="hdrfilm"><integer name="width" value="300"/><integer name="height" value="200"/><integer name="crop_offset_x" value="10"/>
<integer name="crop_width" value="20"/><rfilter type=)") +
                    filter + "</film></sensor>"))
                .scene);
}

TEST(SceneWriter, NumbersComeBack)
{
    std::mt19937 random(1);
    for (int i = 0; i < 100000; i++) {
        const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        if (!std::isfinite(value)) continue;
        const auto read = static_cast<float>(parse_number(number_text(value)).value());
        EXPECT_EQ(std::bit_cast<std::uint32_t>(read), std::bit_cast<std::uint32_t>(value));
    }
    EXPECT_EQ(number_text(0.1f), "0.1");
    EXPECT_EQ(number_text(-0.0f), "-0");
}

TEST(SceneWriter, RefusesWhatXmlCannotSay)
{
    Scene scene = SceneFolder().load(sundog::testing::scene_with("")).scene;
    scene.integrator.method = "a$b";
    const SceneFolder folder;
    EXPECT_THROW(write_scene(scene, folder.path() / "files"), SceneError);
    scene.integrator.method = "";
    const auto blocked = folder.write("blocked", "a file where the folder should be");
    scene.shapes[0].geometry = TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}, {}};
    EXPECT_THROW(write_scene(scene, blocked), FileError);
}

} // namespace
