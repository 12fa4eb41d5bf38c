#include "import/emitter_import.h"

#include "import/bitmap_settings.h"
#include "import/limits.h"
#include "import/sensor_import.h"
#include "import/sky_import.h"
#include "import/text_file.h"
#include "math/direction.h"

#include <numbers>
#include <utility>

namespace sundog
{

namespace
{

constexpr float degree = std::numbers::pi_v<float> / 180.0f;

void ignore_sampling_weight(ObjectReader& reader)
{
    const XmlElement* weight = reader.find("sampling_weight");
    if (weight && weight->attribute("value") && parse_number(*weight->attribute("value")) == 0.0)
        reader.index().warn(weight->where, "the light shines all the same: a sampling_weight of 0 does not switch it off here",
                            WarningKind::approximated);
    reader.ignore("sampling_weight", "lights are chosen by their power");
}

// To places counted from the local origin. Directions know of none.
Transform read_placement(ObjectReader& reader)
{
    return reader.transform("to_world").relative_to(reader.index().origins().world.place);
}

PointEmitter read_point(ObjectReader& reader)
{
    PointEmitter emitter;
    if (reader.has("position") && reader.has("to_world"))
        throw SceneError(reader.where_of("to_world"), "give a point emitter either position or to_world, not both");
    const Transform to_world = read_placement(reader);
    emitter.position = reader.vector("position", reader.index().origins().world.place).value_or(to_world.point({0, 0, 0}));
    check_position(emitter.position, reader.where_of(reader.has("position") ? "position" : "to_world"), "the light");
    emitter.intensity = reader.color("intensity", {1, 1, 1}, ColorRole::emission);
    return emitter;
}

// Unit axes of to_world; throws SceneError where it shears or scales unevenly.
void set_axes(const Transform& to_world, const SourceLocation& where, Vec3& x, Vec3& y, Vec3& z)
{
    if (!to_world.uniform_scale()) throw SceneError(where, "to_world of a light with an image may only rotate, reflect, move and scale evenly");
    x = direction_of(to_world.vector({1, 0, 0}));
    y = direction_of(to_world.vector({0, 1, 0}));
    z = direction_of(to_world.vector({0, 0, 1}));
}

ProjectorEmitter read_projector(ObjectReader& reader, TextureImporter& textures)
{
    ProjectorEmitter emitter;
    const Transform to_world = read_placement(reader);
    set_axes(to_world, reader.where_of("to_world"), emitter.axis_x, emitter.axis_y, emitter.axis_z);
    emitter.position = to_world.point({0, 0, 0});
    check_position(emitter.position, reader.where_of("to_world"), "the light");
    const ColorSource image = textures.color(reader, "irradiance", {1, 1, 1}, ColorRole::emission);
    emitter.texture = image.texture;
    const double scale = reader.number_between("scale", 1.0, 0.0, largest_emission);
    // Mitsuba's irradiance is in units of pi.
    emitter.irradiance = image.value * static_cast<float>(scale * std::numbers::pi);
    check_emission(emitter.irradiance, reader.where_of("scale"), "scale");
    const double aspect = image.texture ? textures.aspect(*image.texture) : 1.0;
    emitter.half_width = static_cast<float>(read_tan_half_x(reader, aspect));
    emitter.half_height = static_cast<float>(emitter.half_width / aspect);
    return emitter;
}

SpotEmitter read_spot(ObjectReader& reader, TextureImporter& textures)
{
    SpotEmitter emitter;
    const Transform to_world = read_placement(reader);
    emitter.position = to_world.point({0, 0, 0});
    check_position(emitter.position, reader.where_of("to_world"), "the light");
    emitter.direction = direction_of(to_world.vector({0, 0, 1}));
    emitter.intensity = reader.color("intensity", {1, 1, 1}, ColorRole::emission);
    const ColorSource texture = textures.color(reader, "texture", {1, 1, 1}, ColorRole::emission);
    emitter.texture = texture.texture;
    emitter.intensity = emitter.intensity * texture.value;
    if (emitter.texture) set_axes(to_world, reader.where_of("to_world"), emitter.axis_x, emitter.axis_y, emitter.direction);
    const double cutoff = reader.number("cutoff_angle", 20.0);
    constexpr double narrowest = 1e-3; // degrees: of a narrower cone the cosine is 1
    const double beam = reader.number("beam_width", 0.75 * cutoff);
    if (!(cutoff >= narrowest && cutoff < 180.0))
        throw SceneError(reader.where_of("cutoff_angle"), "cutoff_angle of a spot must be at least 0.001 and below 180 degrees");
    if (!(beam >= 0.0 && beam <= cutoff))
        throw SceneError(reader.where_of("beam_width"), "beam_width of a spot must be between 0 and its cutoff_angle");
    if (emitter.texture && !(cutoff < 90.0))
        throw SceneError(reader.where_of("cutoff_angle"), "cutoff_angle of a spot with a texture must be below 90 degrees");
    emitter.cutoff_angle = static_cast<float>(cutoff) * degree;
    emitter.beam_width = static_cast<float>(beam) * degree;
    return emitter;
}

DirectionalEmitter read_directional(ObjectReader& reader)
{
    DirectionalEmitter emitter;
    if (reader.has("direction") && reader.has("to_world"))
        throw SceneError(reader.where_of("to_world"), "give a directional emitter either direction or to_world, not both");
    const Transform to_world = read_placement(reader);
    const Vec3 direction = reader.vector("direction").value_or(to_world.vector({0, 0, 1}));
    if (direction == Vec3{0, 0, 0}) throw SceneError(reader.where_of("direction"), "direction of a directional emitter must not be zero");
    emitter.direction = direction_of(direction);
    emitter.irradiance = reader.color("irradiance", {1, 1, 1}, ColorRole::emission);
    return emitter;
}

CollimatedEmitter read_collimated(ObjectReader& reader)
{
    CollimatedEmitter emitter;
    const Transform to_world = read_placement(reader);
    emitter.position = to_world.point({0, 0, 0});
    check_position(emitter.position, reader.where_of("to_world"), "the light");
    emitter.direction = direction_of(to_world.vector({0, 0, 1}));
    emitter.power = reader.color("power", {1, 1, 1}, ColorRole::emission);
    return emitter;
}

EnvironmentEmitter read_environment(ObjectReader& reader, TextureImporter& textures)
{
    EnvironmentEmitter emitter;
    if (reader.has("bitmap")) throw SceneError(reader.where_of("bitmap"), "an envmap takes its image from a file: give <string name=\"filename\">");
    emitter.image = textures.bitmaps().environment(read_bitmap_request(reader), reader.where_of("filename"));
    emitter.scale = static_cast<float>(reader.number_between("scale", 1.0, 0.0, largest_emission));
    const Transform to_world = read_placement(reader);
    set_axes(to_world, reader.where_of("to_world"), emitter.axis_x, emitter.axis_y, emitter.axis_z);
    for (const char* name : {"mis_compensation", "cache"}) reader.ignore(name, "it does not change the image");
    return emitter;
}

// Says, for emitters that are not supported, what to use instead.
void leave_out(ObjectReader& reader)
{
    constexpr std::pair<const char*, const char*> cures[] = {
        {"directionalarea", "use a directional emitter behind a hole of that shape"},
        {"volumelight", "use an area emitter on the volume's surface"},
    };
    std::string details = "; supported are area (inside a shape), point, spot, directional, constant, envmap, sky, sun, sunsky, projector, collimated";
    for (const auto& [type, cure] : cures)
        if (reader.type() == type) details = std::string(": ") + cure;
    reader.missing(details, "it is left out");
}

} // namespace

std::optional<EmitterDescription> import_emitter(const XmlElement& element, const SceneIndex& index, TextureImporter& textures)
{
    ObjectReader reader(element, index);
    const std::string type = reader.type();
    EmitterDescription description;
    description.where = element.where;
    if (type == "point")
        description.model = read_point(reader);
    else if (type == "spot")
        description.model = read_spot(reader, textures);
    else if (type == "directional")
        description.model = read_directional(reader);
    else if (type == "constant")
        description.model = ConstantEmitter{reader.color("radiance", {1, 1, 1}, ColorRole::emission)};
    else if (type == "collimated")
        description.model = read_collimated(reader);
    else if (type == "projector")
        description.model = read_projector(reader, textures);
    else if (type == "envmap")
        description.model = read_environment(reader, textures);
    else if (type == "sky" || type == "sun" || type == "sunsky")
        description.model = read_sun_sky(reader);
    else if (type == "area")
        throw SceneError(element.where, "an area emitter must be inside the <shape> that emits");
    else {
        leave_out(reader);
        return {};
    }
    ignore_sampling_weight(reader);
    reader.finish();
    return description;
}

std::optional<AreaEmitter> import_area_emitter(const XmlElement& element, const SceneIndex& index, TextureImporter& textures)
{
    ObjectReader reader(element, index);
    if (reader.type() == "directionalarea" || reader.type() == "volumelight") {
        leave_out(reader);
        return {};
    }
    if (reader.type() != "area")
        throw SceneError(element.where, "emitter plugin '" + reader.type() + "' cannot be inside a shape: only area emitters can");
    const ColorSource radiance = textures.color(reader, "radiance", {1, 1, 1}, ColorRole::emission);
    const AreaEmitter emitter{radiance.value, radiance.texture};
    ignore_sampling_weight(reader);
    reader.finish();
    return emitter;
}

} // namespace sundog
