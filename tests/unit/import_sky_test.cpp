// Emitters sky, sun and sunsky of scene files; where the sun stands.
#include "import/sun_position.h"
#include "scene_folder.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace sundog::testing
{
namespace
{

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double degree = std::numbers::pi / 180.0;

std::string emitter(const std::string& type, const std::string& inside)
{
    return "<emitter type=\"" + type + "\">" + inside + "</emitter>";
}

SunSkyEmitter read(const std::string& type, const std::string& inside, const std::string& version = "3.0.0")
{
    const auto loaded = load_with(emitter(type, inside), {}, version);
    EXPECT_THAT(loaded.warnings, IsEmpty());
    return std::get<SunSkyEmitter>(loaded.scene.emitters.at(0).model);
}

void expect_refusal(const std::string& inside, const std::string& message)
{
    try {
        load_with(emitter("sunsky", inside));
        FAIL() << "no error about " << message;
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr(message));
        EXPECT_THAT(error.what(), HasSubstr("scene.xml:2"));
    }
}

// Greenwich at the equinox of 2010 (20 March, 17:32 universal time): at noon the sun stands in the south, 90 - 51.48 degrees high
// but for the half degree of a quarter day's declination; the equation of time is -7.5 minutes.
TEST(SunPosition, AtAnEquinox)
{
    PlaceAndTime when{51.4769, 0.0, 0.0, 2010, 3, 20, 12.0, 7.5, 0.0};
    const SunPosition noon = sun_position(when);
    EXPECT_NEAR(noon.polar_angle / degree, 51.4769 + 0.09, 0.02);
    EXPECT_NEAR(noon.azimuth / degree, 180.0, 0.1);
    when.hour = 18.0; // about to set in the west
    EXPECT_NEAR(sun_position(when).polar_angle / degree, 90.0, 0.2);
    EXPECT_NEAR(sun_position(when).azimuth / degree, 270.0, 0.3);
    when.hour = 6.0;
    EXPECT_NEAR(sun_position(when).azimuth / degree, 90.0, 0.3);
}

TEST(SunPosition, KnowsTimezonesAndMonths)
{
    const SunPosition here = sun_position({51.4769, 0.0, 0.0, 2010, 3, 20, 12.0, 0.0, 0.0});
    const SunPosition elsewhere = sun_position({51.4769, 0.0, 5.5, 2010, 3, 20, 17.0, 30.0, 0.0}); // the clock differs, not the place
    EXPECT_NEAR(here.polar_angle, elsewhere.polar_angle, 1e-9);
    EXPECT_NEAR(here.azimuth, elsewhere.azimuth, 1e-9);
    // The solstices at noon: the declination is +-23.44 degrees.
    EXPECT_NEAR(sun_position({51.4769, 0.0, 0.0, 2010, 6, 21, 12.0, 1.7, 0.0}).polar_angle / degree, 51.4769 - 23.44, 0.02);
    EXPECT_NEAR(sun_position({51.4769, 0.0, 0.0, 2010, 12, 21, 11.0, 58.0, 0.0}).polar_angle / degree, 51.4769 + 23.44, 0.02);
}

// East in the morning, with the axes of either version: Mitsuba 3's north is -x and its up z, 0.6's north is -z and its up y.
TEST(ImportSky, SunOfAPlaceAndTime)
{
    const std::string morning = R"(<float name="latitude" value="51.4769"/><float name="longitude" value="0"/><float name="timezone" value="0"/>
        <integer name="month" value="3"/><integer name="day" value="20"/><float name="hour" value="6"/><float name="minute" value="30"/>)";
    const SunSkyEmitter now = read("sunsky", morning), then = read("sunsky", morning, "0.6.0");
    EXPECT_EQ(now.up, (Vec3{0, 0, 1}));
    EXPECT_LT(now.sun_direction.y, -0.99f);
    EXPECT_EQ(then.up, (Vec3{0, 1, 0}));
    EXPECT_GT(then.sun_direction.x, 0.99f);
    EXPECT_NEAR(now.sun_direction.z, then.sun_direction.y, 1e-6f);
    // As Mitsuba 3.7.1 has it by default: its sky is brightest below the sun, at 85.7 degrees of azimuth.
    const Vec3 tokyo = read("sunsky", "").sun_direction;
    EXPECT_NEAR(std::atan2(tokyo.y, tokyo.x) / degree, 85.74, 0.2);
}

TEST(ImportSky, ParametersOfMitsuba3)
{
    const SunSkyEmitter sunsky = read("sunsky", R"(<float name="turbidity" value="7"/><rgb name="albedo" value=".1, .2, .3"/>
        <vector name="sun_direction" x="0" y="2" z="0"/><float name="sun_scale" value="2"/><float name="sky_scale" value="3"/>
        <float name="sun_aperture" value="4"/><boolean name="complex_sun" value="false"/>
        <transform name="to_world"><rotate x="1" angle="-90"/></transform>)");
    EXPECT_EQ(sunsky.turbidity, 7.0f);
    EXPECT_EQ(sunsky.albedo, (Vec3{.1f, .2f, .3f}));
    EXPECT_EQ(sunsky.sun_direction, (Vec3{0, 1, 0})); // in the world
    expect_near(sunsky.up, {0, 1, 0}, 1e-6f);
    EXPECT_EQ(sunsky.sun_scale, 2.0f);
    EXPECT_EQ(sunsky.sky_scale, 3.0f);
    EXPECT_EQ(sunsky.sun_aperture, 4.0f);
    EXPECT_FALSE(sunsky.limb_darkening);
}

TEST(ImportSky, ParametersOfMitsuba06)
{
    const std::string sun = R"(<vector name="sunDirection" x="0" y="1" z="0"/>)";
    EXPECT_EQ(read("sky", sun, "0.5.0").albedo, (Vec3{.2f, .2f, .2f}));
    EXPECT_EQ(read("sky", sun + R"(<float name="scale" value="5"/>)", "0.5.0").sky_scale, 5.0f);
    EXPECT_EQ(read("sky", sun, "0.5.0").sun_scale, 0.0f);
    EXPECT_EQ(read("sun", sun + R"(<float name="scale" value="5"/>)", "0.5.0").sun_scale, 5.0f);
    EXPECT_EQ(read("sun", sun, "0.5.0").sky_scale, 0.0f);
    const SunSkyEmitter both = read("sunsky", sun + R"(<float name="scale" value="5"/><float name="skyScale" value="2"/>
        <float name="sunRadiusScale" value="10"/><float name="stretch" value="1.2"/><boolean name="extend" value="true"/>)", "0.5.0");
    EXPECT_EQ(both.sky_scale, 2.0f);
    EXPECT_EQ(both.sun_scale, 5.0f);
    EXPECT_FLOAT_EQ(both.sun_aperture, 5.358f);
    EXPECT_EQ(both.stretch, 1.2f);
    EXPECT_TRUE(both.extend);
    const auto pointlike = load_with(emitter("sun", sun + R"(<float name="sunRadiusScale" value="0"/><integer name="resolution" value="64"/>)"), {}, "0.5.0");
    EXPECT_THAT(pointlike.warnings, SizeIs(2)); // a small sun; the resolution
    EXPECT_EQ(std::get<SunSkyEmitter>(pointlike.scene.emitters.at(0).model).sun_aperture, 0.01f);
}

TEST(ImportSky, RefusesWhatTheModelDoesNotHave)
{
    expect_refusal(R"(<float name="turbidity" value="0.5"/>)", "turbidity of a sunsky emitter must be between 1 and 10");
    expect_refusal(R"(<vector name="sun_direction" x="0" y="0" z="-1"/>)", "below the horizon");
    expect_refusal(R"(<float name="hour" value="2"/>)", "below the horizon");
    expect_refusal(R"(<vector name="sun_direction" x="0" y="0" z="1"/><float name="hour" value="2"/>)", "not both");
    expect_refusal(R"(<vector name="sun_direction" x="0" y="0" z="0"/>)", "must not be zero");
    expect_refusal(R"(<integer name="month" value="13"/>)", "month");
    expect_refusal(R"(<float name="sun_aperture" value="0"/>)", "angle");
    expect_refusal(R"(<float name="stretch" value="3"/>)", "stretch");
    expect_refusal(R"(<transform name="to_world"><scale x="2"/></transform>)", "scale evenly");
}

TEST(ImportSky, OneEnvironmentOnly)
{
    EXPECT_THROW(load_with(emitter("sky", "") + emitter("sun", "")), SceneError);
    EXPECT_THROW(load_with(emitter("constant", "") + emitter("sun", "")), SceneError);
}

} // namespace
} // namespace sundog::testing
