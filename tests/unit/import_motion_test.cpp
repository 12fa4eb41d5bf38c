// Animations and shutters of scene files.
#include "scene/fingerprint.h"
#include "scene/flat_scene.h"
#include "scene/sensor_pose.h"
#include "unit/scene_folder.h"

#include <gmock/gmock.h>

namespace
{

using namespace sundog;
using namespace sundog::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string keys = "<transform time=\"0\"><translate x=\"1\"/></transform><transform time=\"2\"><translate x=\"5\"/></transform>";
const std::string slide = "<animation name=\"to_world\">" + keys + "</animation>";
const std::string light = "<emitter type=\"point\"/>";

std::string scene_of(const std::string& shapes, const std::string& sensor = "<float name=\"shutter_close\" value=\"1\"/>",
                     const std::string& type = "perspective")
{
    return "<scene version=\"3.0.0\">\n<sensor type=\"" + type + "\">\n" + sensor + "</sensor>\n" + light + shapes + "</scene>";
}

LoadedScene load(const std::string& shapes, const std::string& sensor = "<float name=\"shutter_close\" value=\"1\"/>",
                 const std::string& type = "perspective")
{
    return SceneFolder().load(scene_of(shapes, sensor, type));
}

// A shape that moves lies in its own space, in a group of its own, with one instance.
TEST(ImportMotion, MovingShapesBecomeInstances)
{
    const auto loaded = load("<shape type=\"cube\"/><shape type=\"sphere\" id=\"ball\"><float name=\"radius\" value=\"2\"/>" + slide +
                             "</shape><shape type=\"disk\"/>");
    EXPECT_THAT(loaded.warnings, IsEmpty());
    const Scene& scene = loaded.scene;
    ASSERT_EQ(scene.shapes.size(), 3u);
    EXPECT_FALSE(scene.shapes[0].group);
    EXPECT_EQ(scene.shapes[1].group, 0u);
    EXPECT_FALSE(scene.shapes[2].group);
    expect_near(std::get<Sphere>(scene.shapes[1].geometry).center, {0, 0, 0}, 0);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].group, 0u);
    expect_near(scene.instances[0].to_world.at(0.5).point({0, 0, 0}), {2, 0, 0}, 1e-6f);
    // Until the shutter closes, not until the last key: 1 + 2 + radius.
    expect_near(scene.bounds().lower, {-1, -2, -2}, 1e-6f);
    expect_near(scene.bounds().upper, {5, 2, 2}, 1e-6f);
    const FlatScene flat = flatten_scene(scene);
    ASSERT_EQ(flat.instance_motions.size(), 1u);
    expect_near(flat.instances[0].translation, {1, 0, 0}, 0);
    EXPECT_TRUE(scene.moves());
}

TEST(ImportMotion, LegacyNamesAndMaterialsOfObjFiles)
{
    const SceneFolder folder;
    folder.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl blue\nf 3 2 1\n");
    const auto loaded = folder.load("<scene version=\"0.6.0\"><sensor type=\"perspective\"><float name=\"shutterOpen\" "
                                    "value=\"0.5\"/><float name=\"shutterClose\" value=\"1\"/></sensor>" +
                                    light + "<shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/><animation name=\"toWorld\">" +
                                    keys + "</animation></shape></scene>");
    ASSERT_EQ(loaded.scene.shapes.size(), 2u);
    for (const auto& shape : loaded.scene.shapes) EXPECT_EQ(shape.group, 0u);
    EXPECT_EQ(loaded.scene.instances.size(), 1u);
    EXPECT_EQ(loaded.scene.sensor.shutter.open, 0.5);
    expect_near(flatten_scene(loaded.scene).instances[0].translation, {2, 0, 0}, 1e-6f);
}

TEST(ImportMotion, InstancesMove)
{
    const auto loaded = load("<shape type=\"shapegroup\" id=\"g\"><shape type=\"cube\"/></shape><shape type=\"instance\"><ref id=\"g\"/>" +
                             slide + "</shape><shape type=\"instance\"><ref id=\"g\"/></shape>");
    EXPECT_THAT(loaded.warnings, IsEmpty());
    ASSERT_EQ(loaded.scene.instances.size(), 2u);
    EXPECT_TRUE(loaded.scene.instances[0].to_world.moves(0, 1));
    EXPECT_TRUE(loaded.scene.instances[1].to_world.is_constant());
    EXPECT_EQ(flatten_scene(loaded.scene).instance_motions.size(), 1u);
}

TEST(ImportMotion, CamerasMove)
{
    const std::string sensor =
        "<float name=\"shutter_open\" value=\"0.25\"/><float name=\"shutter_close\" value=\"1\"/><animation name=\"to_world\">"
        "<transform time=\"0\"><lookat origin=\"0,0,5\" target=\"0,0,0\" up=\"0,1,0\"/></transform>"
        "<transform time=\"1\"><lookat origin=\"5,0,0\" target=\"0,0,0\" up=\"0,1,0\"/></transform></animation>";
    const auto loaded = load("<shape type=\"cube\"/>", sensor);
    EXPECT_THAT(loaded.warnings, IsEmpty());
    const Sensor& s = loaded.scene.sensor;
    ASSERT_TRUE(s.motion);
    expect_near(s.position, {1.25f, 0, 3.75f}, 1e-6f);
    const Sensor middle = sensor_at(s, 0.5), end = sensor_at(s, 1);
    expect_near(middle.position, {2.5f, 0, 2.5f}, 1e-6f);
    expect_near(middle.axis_z, Vec3{-1, 0, -1} * std::sqrt(0.5f), 1e-6f);
    expect_near(middle.axis_y, {0, 1, 0}, 1e-6f);
    expect_near(end.axis_z, {-1, 0, 0}, 0);
    EXPECT_TRUE(loaded.scene.moves());
}

TEST(ImportMotion, OrthographicCamerasKeepTheirFilm)
{
    const auto key = [](const char* time, const char* scale, const char* x) {
        return std::string("<transform time=\"") + time + "\"><scale x=\"" + scale + "\" y=\"3\" z=\"1\"/><translate x=\"" + x +
               "\"/></transform>";
    };
    const std::string close = "<float name=\"shutter_close\" value=\"1\"/>";
    const auto loaded =
        load("<shape type=\"cube\"/>", close + "<animation name=\"to_world\">" + key("0", "2", "0") + key("1", "2", "4") + "</animation>",
             "orthographic");
    EXPECT_EQ(loaded.scene.sensor.extent_x, 2.0f);
    expect_near(sensor_at(loaded.scene.sensor, 0.5).position, {2, 0, 0}, 1e-6f);
    EXPECT_THROW(load("<shape type=\"cube\"/>",
                      close + "<animation name=\"to_world\">" + key("0", "2", "0") + key("1", "2.1", "4") + "</animation>", "orthographic"),
                 SceneError);
}

// Nothing that an open shutter could see: shapes are placed as if by a <transform>, to the last bit of what the device gets.
TEST(ImportMotion, WhatStandsStillCostsNothing)
{
    const auto print = [](const LoadedScene& loaded) {
        return fingerprint(flatten_scene(loaded.scene), make_camera(loaded.scene.sensor, loaded.scene.film),
                           make_pixel_filter(loaded.scene.film.filter));
    };
    const auto still = [](double x) {
        return "<shape type=\"cube\"><transform name=\"to_world\"><translate x=\"" + std::to_string(x) + "\"/></transform></shape>";
    };
    const std::string moving = "<shape type=\"cube\">" + slide + "</shape>";
    const auto shutter = [](double open, double close) {
        return "<float name=\"shutter_open\" value=\"" + std::to_string(open) + "\"/><float name=\"shutter_close\" value=\"" +
               std::to_string(close) + "\"/>";
    };
    const LoadedScene instant = load(moving, shutter(0.5, 0.5));
    EXPECT_THAT(instant.warnings, ElementsAre(HasSubstr("scene.xml:4: shape 'cube' stands still: the shutter is open for no time")));
    EXPECT_FALSE(instant.scene.moves());
    EXPECT_TRUE(instant.scene.instances.empty());
    EXPECT_EQ(print(instant), print(load(still(2))));
    EXPECT_EQ(print(load(moving, "")), print(load(still(1)))) << "absent: at time 0";
    EXPECT_EQ(print(load(moving, shutter(2, 3))), print(load(still(5)))) << "after the last key";
    EXPECT_THAT(load(moving, shutter(2, 3)).warnings, IsEmpty());
    const std::string one_key =
        "<shape type=\"cube\"><animation name=\"to_world\"><transform time=\"7\"><translate x=\"5\"/></transform></animation></shape>";
    EXPECT_EQ(print(load(one_key)), print(load(still(5))));
    EXPECT_EQ(print(load(still(5), shutter(0, 1))), print(load(still(5), ""))) << "a shutter alone";
}

// What moves, how, and how long the shutter is open are part of a render's identity.
TEST(ImportMotion, FingerprintKnowsTheMotion)
{
    const auto print = [](const std::string& shapes, const std::string& sensor) {
        const LoadedScene loaded = load(shapes, sensor);
        return fingerprint(flatten_scene(loaded.scene), make_camera(loaded.scene.sensor, loaded.scene.film),
                           make_pixel_filter(loaded.scene.film.filter));
    };
    const std::string hull = "<shape type=\"sphere\"><float name=\"radius\" value=\"99\"/></shape>"; // decides the bounds
    const auto cube = [&](const std::string& end) {
        return hull + "<shape type=\"cube\"><animation name=\"to_world\"><transform time=\"0\"/><transform time=\"1\">" + end +
               "</transform></animation></shape>";
    };
    const std::string one = "<float name=\"shutter_close\" value=\"1\"/>", two = "<float name=\"shutter_close\" value=\"0.5\"/>";
    const std::string up = "<translate y=\"1\"/>", further = "<translate y=\"1.001\"/>";
    EXPECT_EQ(print(cube(up), one), print(cube(up), one));
    EXPECT_NE(print(cube(up), one), print(cube(further), one));
    EXPECT_NE(print(cube(up), one), print(cube(up), two));
    const auto camera = [&](const std::string& end) {
        return one + "<animation name=\"to_world\"><transform time=\"0\"/><transform time=\"1\">" + end + "</transform></animation>";
    };
    EXPECT_NE(print(hull, camera(up)), print(hull, camera(further)));
    EXPECT_NE(print(hull, camera(up)), print(hull, one));
}

TEST(ImportMotion, HalfTurnsAreNamed)
{
    const auto loaded = load("<shape type=\"cube\"><animation name=\"to_world\"><transform time=\"0\"/><transform time=\"0.5\"><rotate "
                             "y=\"1\" angle=\"180\"/></transform></animation></shape>");
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("scene.xml:4: shape 'cube' turns by 180 degrees between the times 0 and 0.5")));
}

struct Broken {
    const char* name;
    const char* message;
    std::string xml;
};

void PrintTo(const Broken& broken, std::ostream* out)
{
    *out << broken.name;
}

class BrokenMotion : public ::testing::TestWithParam<Broken>
{
};

TEST_P(BrokenMotion, IsRefusedWithItsLine)
{
    try {
        SceneFolder().load(GetParam().xml);
        FAIL() << "accepted";
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr(std::string("scene.xml:") + GetParam().message));
    }
}

std::string animated(const std::string& inside)
{
    return scene_of("<shape type=\"cube\"><animation name=\"to_world\">\n" + inside + "</animation></shape>");
}

INSTANTIATE_TEST_SUITE_P(
    All, BrokenMotion,
    ::testing::Values(
        Broken{"NoKeys", "4: the animation is empty", animated("")},
        Broken{"NoTime", "5: <transform> needs the attribute time", animated("<transform/>")},
        Broken{"TimeIsNoNumber", "5: time in <transform> must be a finite number, got 'nan'", animated("<transform time=\"nan\"/>")},
        Broken{"TimesEqual", "6: time 1 does not come after", animated("<transform time=\"1\"/>\n<transform time=\"1\"/>")},
        Broken{"TimesFall", "6: time 0.5 does not come after", animated("<transform time=\"1\"/>\n<transform time=\"0.5\"/>")},
        Broken{"Singular", "6: the transform flattens space",
               animated("<transform time=\"0\"/><transform time=\"1\">\n<scale x=\"0\"/></transform>")},
        Broken{"Mirrored", "6: one of two keys is a reflection",
               animated("<transform time=\"0\"/>\n<transform time=\"1\"><scale x=\"-1\"/></transform>")},
        Broken{"MatrixNan", "6: value in <matrix> must be finite numbers",
               animated("<transform time=\"0\">\n<matrix value=\"nan 0 0 0 1 0 0 0 1\"/></transform>")},
        Broken{"OtherTag", "5: unexpected <rotate> in an animation", animated("<rotate y=\"1\" angle=\"3\"/>")},
        Broken{"KeyWithName", "5: unexpected attribute 'name' in <transform>", animated("<transform name=\"a\" time=\"0\"/>")},
        Broken{"TimeWithoutAnimation", "5: unexpected attribute 'time' in <transform>",
               scene_of("<shape type=\"cube\">\n<transform name=\"to_world\" time=\"0\"/></shape>")},
        Broken{"Twice", "5: parameter 'to_world' of shape 'cube' is given twice",
               scene_of("<shape type=\"cube\">" + slide + "\n<transform name=\"toWorld\"/></shape>")},
        Broken{
            "ShutterBackwards", "4: the shutter closes (shutter_close, 1, default 0) before it opens (shutter_open, 2)",
            scene_of("<shape type=\"cube\"/>", "<float name=\"shutter_open\" value=\"2\"/>\n<float name=\"shutter_close\" value=\"1\"/>")},
        Broken{"ShutterOpenAlone", "3: the shutter closes (shutter_close, 0, default 0) before",
               scene_of("<shape type=\"cube\"/>", "<float name=\"shutter_open\" value=\"2\"/>")},
        Broken{"ShutterNan", "3: value in <float> must be a finite number, got 'nan'",
               scene_of("<shape type=\"cube\"/>", "<float name=\"shutter_close\" value=\"nan\"/>")},
        Broken{"MovingLight", "5: a shape that moves cannot emit light",
               scene_of("<shape type=\"cube\">" + slide + "\n<emitter type=\"area\"/></shape>")},
        Broken{"MovingLamp", "5: emitter 'spot' cannot move",
               scene_of("<shape type=\"cube\"/><emitter type=\"spot\">\n" + slide + "</emitter>")},
        Broken{"MovingTexture", "5: texture 'checkerboard' cannot move",
               scene_of("<shape type=\"cube\"><bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"checkerboard\">\n<animation "
                        "name=\"to_uv\">" +
                        keys + "</animation></texture></bsdf></shape>")},
        Broken{"MovingMember", "5: a shape inside a shapegroup cannot move by itself",
               scene_of("<shape type=\"shapegroup\" id=\"g\"><shape type=\"cube\">\n" + slide +
                        "</shape></shape><shape type=\"instance\"><ref id=\"g\"/></shape>")},
        Broken{"ShearedCamera", "4: to_world of a sensor must not shear",
               scene_of("<shape type=\"cube\"/>", "<float name=\"shutter_close\" value=\"1\"/>\n<animation name=\"to_world\"><transform "
                                                  "time=\"0\"/><transform time=\"1\"><scale x=\"2\"/></transform></animation>")}),
    [](const auto& broken) { return broken.param.name; });

} // namespace
