#include "import/emitter_import.h"

#include "math/direction.h"

#include <numbers>

namespace sundog
{

namespace
{

constexpr float degree = std::numbers::pi_v<float> / 180.0f;

void ignore_sampling_weight(ObjectReader& reader)
{
    reader.ignore("sampling_weight", "lights are chosen by their power");
}

PointEmitter read_point(ObjectReader& reader)
{
    PointEmitter emitter;
    if (reader.has("position") && reader.has("to_world"))
        throw SceneError(reader.where_of("to_world"), "give a point emitter either position or to_world, not both");
    const Transform to_world = reader.transform("to_world");
    emitter.position = reader.vector("position").value_or(to_world.point({0, 0, 0}));
    emitter.intensity = reader.color("intensity", {1, 1, 1}, ColorRole::emission);
    return emitter;
}

SpotEmitter read_spot(ObjectReader& reader)
{
    SpotEmitter emitter;
    const Transform to_world = reader.transform("to_world");
    emitter.position = to_world.point({0, 0, 0});
    emitter.direction = direction_of(to_world.vector({0, 0, 1}));
    emitter.intensity = reader.color("intensity", {1, 1, 1}, ColorRole::emission);
    reader.refuse("texture", "remove it");
    const double cutoff = reader.number("cutoff_angle", 20.0);
    const double beam = reader.number("beam_width", 0.75 * cutoff);
    if (!(cutoff > 0.0 && cutoff < 180.0))
        throw SceneError(reader.where_of("cutoff_angle"), "cutoff_angle of a spot must be in (0, 180) degrees");
    if (!(beam >= 0.0 && beam <= cutoff))
        throw SceneError(reader.where_of("beam_width"), "beam_width of a spot must be between 0 and its cutoff_angle");
    emitter.cutoff_angle = static_cast<float>(cutoff) * degree;
    emitter.beam_width = static_cast<float>(beam) * degree;
    return emitter;
}

DirectionalEmitter read_directional(ObjectReader& reader)
{
    DirectionalEmitter emitter;
    if (reader.has("direction") && reader.has("to_world"))
        throw SceneError(reader.where_of("to_world"), "give a directional emitter either direction or to_world, not both");
    const Transform to_world = reader.transform("to_world");
    const Vec3 direction = reader.vector("direction").value_or(to_world.vector({0, 0, 1}));
    if (direction == Vec3{0, 0, 0}) throw SceneError(reader.where_of("direction"), "direction of a directional emitter must not be zero");
    emitter.direction = direction_of(direction);
    emitter.irradiance = reader.color("irradiance", {1, 1, 1}, ColorRole::emission);
    return emitter;
}

} // namespace

EmitterDescription import_emitter(const XmlElement& element, const SceneIndex& index)
{
    ObjectReader reader(element, index);
    const std::string type = reader.type();
    EmitterDescription description;
    description.where = element.where;
    if (type == "point")
        description.model = read_point(reader);
    else if (type == "spot")
        description.model = read_spot(reader);
    else if (type == "directional")
        description.model = read_directional(reader);
    else if (type == "constant")
        description.model = ConstantEmitter{reader.color("radiance", {1, 1, 1}, ColorRole::emission)};
    else if (type == "area")
        throw SceneError(element.where, "an area emitter must be inside the <shape> that emits");
    else
        reader.unsupported("area (inside a shape), point, spot, directional, constant");
    ignore_sampling_weight(reader);
    reader.finish();
    return description;
}

AreaEmitter import_area_emitter(const XmlElement& element, const SceneIndex& index)
{
    ObjectReader reader(element, index);
    if (reader.type() != "area")
        throw SceneError(element.where, "emitter plugin '" + reader.type() + "' cannot be inside a shape: only area emitters can");
    const AreaEmitter emitter{reader.color("radiance", {1, 1, 1}, ColorRole::emission)};
    ignore_sampling_weight(reader);
    reader.finish();
    return emitter;
}

} // namespace sundog
