#include "import/sky_import.h"

#include "import/sun_position.h"
#include "math/direction.h"
#include "math/double3.h"

#include <cmath>
#include <numbers>

namespace sundog
{

namespace
{

constexpr float natural_aperture = 0.5358f; // degrees
constexpr float least_aperture = 0.01f;     // what stands for a sun without extent
constexpr const char* time_and_place[] = {"latitude", "longitude", "timezone", "year", "month", "day", "hour", "minute", "second"};

double within(ObjectReader& reader, const char* name, double fallback, double least, double most, const char* range)
{
    const double value = reader.number(name, fallback);
    if (!(value >= least && value <= most))
        throw SceneError(reader.where_of(name), std::string(name) + " of a " + reader.type() + " emitter must be " + range);
    return value;
}

float scale(ObjectReader& reader, const char* name, double fallback)
{
    return static_cast<float>(within(reader, name, fallback, 0.0, 1e30, ">= 0 and finite"));
}

PlaceAndTime read_place_and_time(ObjectReader& reader)
{
    PlaceAndTime when;
    when.latitude = within(reader, "latitude", when.latitude, -90.0, 90.0, "between -90 and 90 degrees");
    when.longitude = within(reader, "longitude", when.longitude, -360.0, 360.0, "between -360 and 360 degrees");
    when.timezone = within(reader, "timezone", when.timezone, -24.0, 24.0, "between -24 and 24 hours");
    when.year = reader.integer("year", when.year);
    when.month = reader.integer("month", when.month);
    when.day = reader.integer("day", when.day);
    if (when.year < 1 || when.year > 9999) throw SceneError(reader.where_of("year"), "year must be between 1 and 9999");
    if (when.month < 1 || when.month > 12) throw SceneError(reader.where_of("month"), "month must be between 1 and 12");
    if (when.day < 1 || when.day > 31) throw SceneError(reader.where_of("day"), "day must be between 1 and 31");
    when.hour = within(reader, "hour", when.hour, 0.0, 24.0, "between 0 and 24");
    when.minute = within(reader, "minute", when.minute, 0.0, 60.0, "between 0 and 60");
    when.second = within(reader, "second", when.second, 0.0, 60.0, "between 0 and 60");
    return when;
}

// In the emitter's own space: 0.6 has y up, x in the east and -z in the north; Mitsuba 3 has z up, and north along -x.
Vec3 local_direction(const SunPosition& sun, bool legacy)
{
    const double sine = std::sin(sun.polar_angle);
    const auto up = static_cast<float>(std::cos(sun.polar_angle)), north = static_cast<float>(std::cos(sun.azimuth) * sine),
               east = static_cast<float>(std::sin(sun.azimuth) * sine);
    return legacy ? Vec3{east, up, -north} : Vec3{-north, -east, up};
}

// Towards the sun, in the world.
Vec3 read_sun_direction(ObjectReader& reader, const Transform& to_world)
{
    const auto given = reader.vector("sun_direction");
    if (!given) return direction_of(to_world.vector(local_direction(sun_position(read_place_and_time(reader)), reader.index().legacy())));
    for (const char* name : time_and_place)
        if (reader.has(name))
            throw SceneError(reader.where_of(name),
                             "give a " + reader.type() + " emitter either sun_direction or a place and time, not both");
    if (*given == Vec3{0, 0, 0}) throw SceneError(reader.where_of("sun_direction"), "sun_direction must not be zero");
    return direction_of(*given);
}

float read_aperture(ObjectReader& reader)
{
    if (reader.has("sun_aperture") && reader.has("sun_radius_scale"))
        throw SceneError(reader.where_of("sun_radius_scale"), "give either sun_aperture or sun_radius_scale, not both");
    const double factor = within(reader, "sun_radius_scale", 1.0, 0.0, 300.0, "between 0 and 300");
    if (factor == 0.0) {
        reader.index().warn(reader.where_of("sun_radius_scale"), "a sun without extent is rendered with a diameter of 0.01 degrees",
                            WarningKind::approximated);
        return least_aperture;
    }
    const double aperture = reader.number("sun_aperture", static_cast<double>(natural_aperture) * factor);
    if (!(aperture >= static_cast<double>(least_aperture) && aperture < 179.0))
        throw SceneError(reader.where_of(reader.has("sun_aperture") ? "sun_aperture" : "sun_radius_scale"),
                         "the sun must be seen under an angle between 0.01 and 179 degrees");
    return static_cast<float>(aperture);
}

} // namespace

SunSkyEmitter read_sun_sky(ObjectReader& reader)
{
    const bool legacy = reader.index().legacy();
    const std::string type = reader.type();
    SunSkyEmitter emitter;
    const Transform to_world = reader.transform("to_world");
    if (!to_world.uniform_scale())
        throw SceneError(reader.where_of("to_world"), "to_world of a " + type + " emitter may only rotate, reflect, move and scale evenly");
    emitter.up = direction_of(to_world.vector(legacy ? Vec3{0, 1, 0} : Vec3{0, 0, 1}));
    emitter.sun_direction = read_sun_direction(reader, to_world);
    if (dot(emitter.up, emitter.sun_direction) < 0.0f)
        throw SceneError(
            reader.where(),
            "the sun is below the horizon, where the model of the sky has no data: choose another sun_direction, place or time");
    emitter.turbidity = static_cast<float>(within(reader, "turbidity", 3.0, 1.0, 10.0, "between 1 and 10"));
    const float ground = legacy ? 0.2f : 0.3f;
    emitter.albedo = reader.color("albedo", {ground, ground, ground}, ColorRole::reflectance);
    const double both = within(reader, "scale", 1.0, 0.0, 1e30, ">= 0 and finite");
    emitter.sky_scale = type == "sun" ? 0.0f : scale(reader, "sky_scale", both);
    emitter.sun_scale = type == "sky" ? 0.0f : scale(reader, "sun_scale", both);
    if (type != "sky") {
        emitter.sun_aperture = read_aperture(reader);
        emitter.limb_darkening = reader.boolean("complex_sun", true);
    }
    emitter.stretch = static_cast<float>(within(reader, "stretch", 1.0, 1.0, 2.0, "between 1 and 2"));
    emitter.extend = reader.boolean("extend", false);
    reader.ignore("resolution", "the sky is kept at a resolution that shows no difference");
    return emitter;
}

} // namespace sundog
