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

Transform frame(Vec3 x, Vec3 y, Vec3 z, Vec3 origin)
{
    Transform t;
    t.m[0] = {x.x, y.x, z.x, origin.x};
    t.m[1] = {x.y, y.y, z.y, origin.y};
    t.m[2] = {x.z, y.z, z.z, origin.z};
    return t;
}

ColorSource source(Vec3 value, const std::optional<uint>& texture)
{
    return texture ? ColorSource(value, *texture) : ColorSource(value);
}

// Any pose with that axis, for what is the same all around it.
Transform pose_around_axis(Vec3 origin, Vec3 axis)
{
    const Double3 position{origin.x, origin.y, origin.z};
    const Double3 z{axis.x, axis.y, axis.z};
    auto to_world = Transform::look_at({0, 0, 0}, z, {}).value();
    for (std::size_t i = 0; i < 3; i++) {
        to_world.m[i][2] = z[i];
        to_world.m[i][3] = position[i];
    }
    return to_world;
}

// One of each alternative of EmitterDescription::model.
struct EmitterWriter {
    ObjectWriter root;
    const TextureWriter& textures;
    WrittenFiles& files;
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
        object.transform("to_world", spot.texture ? frame(spot.axis_x, spot.axis_y, spot.direction, spot.position) : pose_around_axis(spot.position, spot.direction));
        object.color("intensity", spot.intensity);
        if (spot.texture) textures.color(object, "texture", source({1, 1, 1}, spot.texture));
        object.number("cutoff_angle", degrees(spot.cutoff_angle, where));
        object.number("beam_width", degrees(spot.beam_width, where));
    }

    void operator()(const DirectionalEmitter& directional)
    {
        ObjectWriter object = root.object("emitter", "directional");
        object.vector("vector", "direction", directional.direction);
        object.color("irradiance", directional.irradiance);
    }

    void operator()(const CollimatedEmitter& collimated)
    {
        ObjectWriter object = root.object("emitter", "collimated");
        object.transform("to_world", pose_around_axis(collimated.position, collimated.direction));
        object.color("power", collimated.power);
    }

    void operator()(const ConstantEmitter& constant) { root.object("emitter", "constant").color("radiance", constant.radiance); }

    void operator()(const EnvironmentEmitter& environment)
    {
        ObjectWriter object = root.object("emitter", "envmap");
        object.text("filename", files.add_image(environment.image));
        object.number("scale", environment.scale);
        object.transform("to_world", frame(environment.axis_x, environment.axis_y, environment.axis_z, {0, 0, 0}));
    }

    // stretch and extend are Mitsuba 0.6's: Mitsuba 3 has neither, so they are written only where they do something.
    void operator()(const SunSkyEmitter& emitter)
    {
        ObjectWriter object = root.object("emitter", "sunsky");
        object.transform("to_world", pose_around_axis({0, 0, 0}, emitter.up));
        object.vector("vector", "sun_direction", emitter.sun_direction);
        object.number("turbidity", emitter.turbidity);
        object.color("albedo", emitter.albedo);
        object.number("sky_scale", emitter.sky_scale);
        object.number("sun_scale", emitter.sun_scale);
        object.number("sun_aperture", emitter.sun_aperture);
        object.boolean("complex_sun", emitter.limb_darkening);
        if (emitter.stretch != 1.0f) object.number("stretch", emitter.stretch);
        if (emitter.extend) object.boolean("extend", true);
    }

    void operator()(const ProjectorEmitter& projector)
    {
        ObjectWriter object = root.object("emitter", "projector");
        object.transform("to_world", frame(projector.axis_x, projector.axis_y, projector.axis_z, projector.position));
        // In units of pi, as the factor of a gray one; rounded to a float, the product is what it was.
        const Vec3 e = projector.irradiance;
        const bool gray = e.x == e.y && e.y == e.z;
        object.number("scale", (gray ? e.x : 1.0) / std::numbers::pi);
        textures.color(object, "irradiance", source(gray ? Vec3{1, 1, 1} : e, projector.texture));
        object.number("fov", projector_fov(projector));
        object.text("fov_axis", "x");
    }

    // Degrees. The height follows from the shape of the image, unless that was scaled down to a slightly different one.
    double projector_fov(const ProjectorEmitter& projector) const
    {
        const double fov = 2.0 * std::atan(static_cast<double>(projector.half_width)) * 180.0 / std::numbers::pi;
        const auto again = static_cast<float>(std::tan(0.5 * (std::numbers::pi / 180.0) * fov));
        const auto height = static_cast<float>(projector.half_width / textures.aspect(projector.texture));
        if (again != projector.half_width || !(fov < 180.0))
            throw SceneError(where, "--dump cannot write the fov of the projector to the last bit: make it smaller");
        if (height != projector.half_height)
            throw SceneError(where, "--dump cannot write a projector whose image was scaled down to another aspect: scale it down yourself");
        return fov;
    }
};

} // namespace

void write_emitters(ObjectWriter root, const Scene& scene, const TextureWriter& textures, WrittenFiles& files)
{
    for (const auto& emitter : scene.emitters) std::visit(EmitterWriter{root, textures, files, emitter.where}, emitter.model);
}

} // namespace sundog
