#include "import/emitter_writer.h"

#include "import/preimage.h"

#include <numbers>

namespace sundog
{

namespace
{

// Degrees that the importer turns into these radians.
float degrees(float radians, const SourceLocation& where)
{
    constexpr float degree = std::numbers::pi_v<float> / 180.0f;
    const auto found = find_near(radians / degree, [&](float d) { return d * degree == radians; });
    if (!found) throw SceneError(where, "an angle of the spot has no exact counterpart in degrees: give it fewer digits");
    return *found;
}

// One of each alternative of EmitterDescription::model.
struct EmitterWriter {
    ObjectWriter root;
    const SourceLocation& where;

    void operator()(const PointEmitter& point)
    {
        ObjectWriter object = root.object("emitter", "point");
        object.vector("point", "position", point.position);
        object.color("intensity", point.intensity);
    }

    void operator()(const SpotEmitter& spot)
    {
        ObjectWriter object = root.object("emitter", "spot");
        const Double3 position{spot.position.x, spot.position.y, spot.position.z};
        const Double3 z{spot.direction.x, spot.direction.y, spot.direction.z};
        auto to_world = Transform::look_at({0, 0, 0}, z, {}).value();
        for (std::size_t i = 0; i < 3; i++) {
            to_world.m[i][2] = z[i];
            to_world.m[i][3] = position[i];
        }
        object.transform("to_world", to_world);
        object.color("intensity", spot.intensity);
        object.number("cutoff_angle", degrees(spot.cutoff_angle, where));
        object.number("beam_width", degrees(spot.beam_width, where));
    }

    void operator()(const DirectionalEmitter& directional)
    {
        ObjectWriter object = root.object("emitter", "directional");
        object.vector("vector", "direction", directional.direction);
        object.color("irradiance", directional.irradiance);
    }

    void operator()(const ConstantEmitter& constant) { root.object("emitter", "constant").color("radiance", constant.radiance); }
};

} // namespace

void write_emitters(ObjectWriter root, const Scene& scene)
{
    for (const auto& emitter : scene.emitters) std::visit(EmitterWriter{root, emitter.where}, emitter.model);
}

} // namespace sundog
