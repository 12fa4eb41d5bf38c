#include "unit/scene_folder.h"

#include <gmock/gmock.h>
#include <numbers>

namespace
{

using namespace sundog;
using sundog::testing::expect_near;
using sundog::testing::SceneFolder;

LoadedScene load_sensor(const std::string& inside, const std::string& type = "perspective")
{
    return SceneFolder().load("<scene version=\"3.0.0\"><sensor type=\"" + type + "\">" + inside +
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
}

TEST(ImportSensor, ThinLensNeedsNoFocusDistance)
{
    const Sensor lens = load_sensor("<float name=\"aperture_radius\" value=\"0.2\"/>", "thinlens").scene.sensor;
    EXPECT_FLOAT_EQ(lens.aperture_radius, 0.2f);
    EXPECT_FLOAT_EQ(lens.focus_distance, 1e4f);
}

} // namespace
