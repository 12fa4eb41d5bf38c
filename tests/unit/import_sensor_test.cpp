#include "unit/scene_folder.h"

#include <gmock/gmock.h>
#include <numbers>

namespace
{

using namespace sundog;
using sundog::testing::expect_near;
using sundog::testing::SceneFolder;

LoadedScene load_sensor(const std::string& inside, const std::string& type = "perspective", const std::string& version = "3.0.0")
{
    return SceneFolder().load("<scene version=\"" + version + "\"><sensor type=\"" + type + "\">" + inside +
                              "</sensor><shape type=\"rectangle\"><emitter type=\"area\"/></shape></scene>");
}

double fov_degrees(const std::string& fov, const std::string& axis, int width, int height)
{
    const auto loaded = load_sensor("<float name=\"fov\" value=\"" + fov + "\"/><string name=\"fov_axis\" value=\"" + axis +
                                    "\"/><film type=\"hdrfilm\"><integer name=\"width\" value=\"" + std::to_string(width) +
                                    "\"/><integer name=\"height\" value=\"" + std::to_string(height) + "\"/></film>");
    return loaded.scene.sensor.fov_x * 180 / std::numbers::pi;
}

// What the horizontal field of view must be when `degrees` spans `reference` of a film `width` wide.
double expected(double degrees, double reference, double width)
{
    return 2 * std::atan(std::tan(degrees * std::numbers::pi / 360) * width / reference) * 180 / std::numbers::pi;
}

TEST(ImportSensor, BordersAreAlwaysSampledFromBothSides)
{
    const auto film = [](const std::string& value) {
        return load_sensor("<film type=\"hdrfilm\"><boolean name=\"sample_border\" value=\"" + value + "\"/></film>").warnings;
    };
    EXPECT_THAT(film("true"), ::testing::IsEmpty());
    EXPECT_THAT(film("false"), ::testing::ElementsAre(::testing::HasSubstr("sample_border is taken as true")));
}

TEST(ImportSensor, FieldOfViewAxes)
{
    EXPECT_NEAR(fov_degrees("50", "x", 400, 300), 50, 1e-4);
    EXPECT_NEAR(fov_degrees("50", "y", 400, 300), expected(50, 300, 400), 1e-4);
    EXPECT_NEAR(fov_degrees("50", "diagonal", 400, 300), expected(50, 500, 400), 1e-4);
    EXPECT_NEAR(fov_degrees("50", "smaller", 400, 300), expected(50, 300, 400), 1e-4);
    EXPECT_NEAR(fov_degrees("50", "larger", 400, 300), 50, 1e-4);
    EXPECT_NEAR(fov_degrees("50", "smaller", 300, 400), 50, 1e-4);
    EXPECT_NEAR(fov_degrees("50", "larger", 300, 400), expected(50, 400, 300), 1e-4);
}

TEST(ImportSensor, FocalLengthsAreOfTheDiagonalOf35mmFilm)
{
    // On a film of 36 x 24 a 50 mm lens sees 2 atan(18 / 50) across.
    const std::string film =
        "<film type=\"hdrfilm\"><integer name=\"width\" value=\"360\"/><integer name=\"height\" value=\"240\"/></film>";
    EXPECT_NEAR(load_sensor(film).scene.sensor.fov_x, 2 * std::atan(18.0 / 50.0), 1e-6);
    EXPECT_NEAR(load_sensor(film + "<string name=\"focal_length\" value=\"35mm\"/>").scene.sensor.fov_x, 2 * std::atan(18.0 / 35.0), 1e-6);
    // The default film is 4 : 3, of which 0.8 of the diagonal lie across.
    EXPECT_NEAR(load_sensor("").scene.sensor.fov_x, 2 * std::atan(0.8 * std::hypot(18.0, 12.0) / 50.0), 1e-6);
}

TEST(ImportSensor, DefaultsAreMitsubas)
{
    const Scene scene = load_sensor("").scene;
    EXPECT_EQ(scene.film.width, 768);
    EXPECT_EQ(scene.film.crop_height, 576);
    EXPECT_EQ(scene.film.filter.kind, FilterKind::gaussian);
    EXPECT_FLOAT_EQ(scene.film.filter.radius, 2.0f);
    EXPECT_FLOAT_EQ(scene.sensor.near_clip, 0.01f);
    EXPECT_FLOAT_EQ(scene.sensor.far_clip, 1e4f);
    EXPECT_EQ(scene.sensor.aperture_radius, 0.0f);
    expect_near(scene.sensor.axis_x, {1, 0, 0}, 0);
    expect_near(scene.sensor.axis_z, {0, 0, 1}, 0);
    EXPECT_EQ(scene.integrator.method, "");
    EXPECT_EQ(scene.integrator.sample_count, 0);
}

TEST(ImportSensor, PoseIsOrthonormalAndMirrorsWithItsTransform)
{
    const std::string look = "<lookat origin=\"1, 2, 3\" target=\"4, 2, 7\" up=\"0, 1, 0\"/>";
    const Sensor straight = load_sensor("<transform name=\"to_world\">" + look + "</transform>").scene.sensor;
    const Sensor mirrored = load_sensor("<transform name=\"to_world\"><scale x=\"-1\"/>" + look + "</transform>").scene.sensor;
    expect_near(straight.position, {1, 2, 3}, 0);
    expect_near(straight.axis_z, {0.6f, 0, 0.8f}, 1e-6f);
    expect_near(straight.axis_y, {0, 1, 0}, 1e-6f);
    expect_near(straight.axis_x, cross(straight.axis_y, straight.axis_z), 1e-6f);
    expect_near(mirrored.axis_x, -straight.axis_x, 1e-6f);
    expect_near(mirrored.axis_z, straight.axis_z, 1e-6f);
    const auto scaled = load_sensor("<transform name=\"to_world\"><scale value=\"3\"/>" + look + "</transform>");
    EXPECT_NEAR(length(scaled.scene.sensor.axis_y), 1.0f, 1e-6f);
    ASSERT_EQ(scaled.warnings.size(), 1u);
    EXPECT_THAT(scaled.warnings[0], ::testing::HasSubstr("scale in to_world"));
}

TEST(ImportSensor, CropsDefaultToTheRestOfTheFilm)
{
    const auto film = [](const std::string& inside) {
        return load_sensor("<film type=\"hdrfilm\"><integer name=\"width\" value=\"100\"/><integer name=\"height\" value=\"80\"/>" +
                           inside + "</film>")
            .scene.film;
    };
    EXPECT_EQ(film("").crop_width, 100);
    const Film offset = film("<integer name=\"crop_offset_x\" value=\"30\"/>");
    EXPECT_EQ(offset.crop_x, 30);
    EXPECT_EQ(offset.crop_width, 70);
    EXPECT_EQ(offset.crop_height, 80);
}

TEST(ImportSensor, Filters)
{
    const auto filter = [](const std::string& xml) { return load_sensor("<film type=\"hdrfilm\">" + xml + "</film>").scene.film.filter; };
    EXPECT_EQ(filter("<rfilter type=\"box\"/>").kind, FilterKind::box);
    EXPECT_FLOAT_EQ(filter("<rfilter type=\"box\"/>").radius, 0.5f);
    EXPECT_FLOAT_EQ(filter("<rfilter type=\"gaussian\"><float name=\"stddev\" value=\"0.3\"/></rfilter>").radius, 1.2f);
    const auto mitchell = filter("<rfilter type=\"mitchell\"><float name=\"B\" value=\"0.2\"/><float name=\"C\" value=\"0.4\"/></rfilter>");
    EXPECT_EQ(mitchell.kind, FilterKind::mitchell);
    EXPECT_FLOAT_EQ(mitchell.b, 0.2f);
    EXPECT_FLOAT_EQ(mitchell.c, 0.4f);
    EXPECT_FLOAT_EQ(mitchell.radius, 2.0f);
    EXPECT_FLOAT_EQ(filter("<rfilter type=\"catmullrom\"/>").c, 0.5f);
    EXPECT_EQ(filter("<rfilter type=\"lanczos\"/>").kind, FilterKind::lanczos);
    EXPECT_FLOAT_EQ(filter("<rfilter type=\"lanczos\"/>").radius, 3.0f);
    EXPECT_FLOAT_EQ(filter("<rfilter type=\"lanczos\"><integer name=\"lobes\" value=\"4\"/></rfilter>").radius, 4.0f);
}

TEST(ImportSensor, OrthographicFilmsAreSizedByTheScale)
{
    const Sensor plain = load_sensor("", "orthographic").scene.sensor;
    EXPECT_EQ(plain.projection, Projection::orthographic);
    EXPECT_EQ(plain.extent_x, 1.0f);
    EXPECT_EQ(plain.extent_y, 1.0f);
    EXPECT_EQ(plain.aperture_radius, 0.0f);
    const std::string inside = "<transform name=\"to_world\"><scale x=\"3\" y=\"2\" z=\"4\"/><lookat origin=\"1, 2, 3\" target=\"4, 2, 7\" "
                               "up=\"0, 1, 0\"/></transform><float name=\"near_clip\" value=\"0.5\"/><float name=\"far_clip\" value=\"10\"/>";
    const auto scaled = load_sensor(inside, "orthographic");
    const Sensor& sensor = scaled.scene.sensor;
    EXPECT_TRUE(scaled.warnings.empty()) << "here the scale has an effect";
    EXPECT_NEAR(sensor.extent_x, 3.0f, 1e-6f);
    EXPECT_NEAR(sensor.extent_y, 2.0f, 1e-6f);
    expect_near(sensor.position, {1, 2, 3}, 0);
    expect_near(sensor.axis_z, {0.6f, 0, 0.8f}, 1e-6f);
    expect_near(sensor.axis_y, {0, 1, 0}, 1e-6f);
    EXPECT_NEAR(length(sensor.axis_x), 1.0f, 1e-6f);
    // Mitsuba 3.9: rays start at to_world (., ., near_clip) and are far_clip - near_clip long. 0.6: both are distances.
    EXPECT_NEAR(sensor.near_clip, 2.0f, 1e-6f);
    EXPECT_NEAR(sensor.far_clip, 11.5f, 1e-5f);
    const Sensor old = load_sensor(inside, "orthographic", "0.6.0").scene.sensor;
    EXPECT_EQ(old.near_clip, 0.5f);
    EXPECT_EQ(old.far_clip, 10.0f);
}

TEST(ImportSensor, TelecentricIsOrthographicWithALens)
{
    const Sensor sensor =
        load_sensor("<float name=\"apertureRadius\" value=\"0.2\"/><float name=\"focusDistance\" value=\"6\"/>", "telecentric", "0.6.0").scene.sensor;
    EXPECT_EQ(sensor.projection, Projection::orthographic);
    EXPECT_FLOAT_EQ(sensor.aperture_radius, 0.2f);
    EXPECT_FLOAT_EQ(sensor.focus_distance, 6.0f);
}

TEST(ImportSensor, PrincipalPointOffsetsAreFractionsOfTheFilm)
{
    const auto loaded = load_sensor("<float name=\"principal_point_offset_x\" value=\"0.1\"/><float name=\"principal_point_offset_y\" value=\"-0.2\"/>");
    EXPECT_FLOAT_EQ(loaded.scene.sensor.principal_offset_x, 0.1f);
    EXPECT_FLOAT_EQ(loaded.scene.sensor.principal_offset_y, -0.2f);
    EXPECT_TRUE(loaded.warnings.empty());
}

TEST(ImportSensor, FilmsOfOtherFilesAreTakenAsHdrfilm)
{
    for (const std::string type : {"ldrfilm", "tiledhdrfilm", "mfilm"}) {
        const auto loaded = load_sensor("<film type=\"" + type + "\"><integer name=\"cropOffsetX\" value=\"0\"/></film>", "perspective", "0.6.0");
        ASSERT_EQ(loaded.warnings.size(), 1u) << type;
        EXPECT_THAT(loaded.warnings[0], ::testing::HasSubstr("film '" + type + "' is taken as hdrfilm"));
        EXPECT_EQ(loaded.scene.film.width, type == "mfilm" ? 1 : 768);
        EXPECT_EQ(loaded.scene.film.crop_height, type == "mfilm" ? 1 : 576);
    }
}

TEST(ImportSensor, ThinLensNeedsNoFocusDistance)
{
    const Sensor lens = load_sensor("<float name=\"aperture_radius\" value=\"0.2\"/>", "thinlens").scene.sensor;
    EXPECT_FLOAT_EQ(lens.aperture_radius, 0.2f);
    EXPECT_FLOAT_EQ(lens.focus_distance, 1e4f);
}

} // namespace
