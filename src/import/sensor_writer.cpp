#include "import/sensor_writer.h"

#include "import/preimage.h"
#include "math/direction.h"
#include "scene/sensor_pose.h"

#include <cmath>
#include <numbers>

namespace sundog
{

namespace
{

void write_filter(ObjectWriter film, const ReconstructionFilter& filter)
{
    switch (filter.kind) {
    case FilterKind::box: {
        ObjectWriter box = film.object("rfilter", "box");
        if (filter.radius != 0.5f) box.number("radius", filter.radius); // which Mitsuba 3 does not know
        return;
    }
    case FilterKind::tent:
        film.object("rfilter", "tent").number("radius", filter.radius);
        return;
    case FilterKind::gaussian:
        film.object("rfilter", "gaussian").number("stddev", filter.stddev);
        return;
    case FilterKind::mitchell: {
        ObjectWriter mitchell = film.object("rfilter", "mitchell");
        mitchell.number("b", filter.b);
        mitchell.number("c", filter.c);
        return;
    }
    case FilterKind::lanczos:
        film.object("rfilter", "lanczos").integer("lobes", std::lround(filter.radius));
        return;
    }
    throw std::logic_error("a reconstruction filter that cannot be written");
}

void write_film(ObjectWriter sensor, const Film& film)
{
    ObjectWriter object = sensor.object("film", "hdrfilm");
    object.integer("width", film.width);
    object.integer("height", film.height);
    if (film.crop_x != 0 || film.crop_y != 0 || film.crop_width != film.width || film.crop_height != film.height) {
        object.integer("crop_offset_x", film.crop_x);
        object.integer("crop_offset_y", film.crop_y);
        object.integer("crop_width", film.crop_width);
        object.integer("crop_height", film.crop_height);
    }
    write_filter(object, film.filter);
}

void set_column(Transform& t, std::size_t j, Vec3 v)
{
    t.m[0][j] = v.x;
    t.m[1][j] = v.y;
    t.m[2][j] = v.z;
}

// to_world of the sensor, `scaled` making it of a pose.
template <class Scaled> AnimatedTransform placed(const Sensor& sensor, Scaled scaled)
{
    if (!sensor.motion) return scaled(sensor);
    std::vector<TransformKey> keys = sensor.motion->keys();
    for (TransformKey& key : keys) key.transform = scaled(sensor_at(sensor, key.time));
    return AnimatedTransform(keys);
}

template <class T> T required(const std::optional<T>& found, const Sensor& sensor)
{
    if (!found) throw SceneError(sensor.where, "the sensor cannot be written to the last bit: remove the shear in its to_world");
    return *found;
}

// Degrees; the largest below 180 for what rounds to pi, from which the importer makes the same.
double degrees(float radians)
{
    return std::min(static_cast<double>(radians) * 180.0 / std::numbers::pi, std::nextafter(180.0, 0.0));
}

void write_perspective(ObjectWriter object, const Sensor& sensor)
{
    object.transform("to_world", placed(sensor, pose_of));
    object.number("fov", degrees(sensor.fov_x));
    object.text("fov_axis", "x");
    if (sensor.principal_offset_x != 0.0f) object.number("principal_point_offset_x", sensor.principal_offset_x);
    if (sensor.principal_offset_y != 0.0f) object.number("principal_point_offset_y", sensor.principal_offset_y);
    object.number("near_clip", sensor.near_clip);
    object.number("far_clip", sensor.far_clip);
}

// The extents are the scale of to_world's first two columns. The third has none, so that the near plane of Mitsuba 3,
// which is scaled, is where it is in the scene; the far one, at an unscaled distance from it, loses a rounding.
Transform orthographic_to_world(const Sensor& sensor)
{
    Transform to_world = pose_of(sensor);
    const auto x = find_near(sensor.axis_x * sensor.extent_x, [&](Vec3 v) { return direction_and_length(v).length == sensor.extent_x; });
    const auto y = find_near(sensor.axis_y * sensor.extent_y, [&](Vec3 v) {
        const auto [direction, length] = direction_and_length(v);
        return direction == sensor.axis_y && length == sensor.extent_y;
    });
    set_column(to_world, 0, required(x, sensor));
    set_column(to_world, 1, required(y, sensor));
    return to_world;
}

// Returns far_clip as it is written.
float write_orthographic(ObjectWriter object, const Sensor& sensor)
{
    object.transform("to_world", placed(sensor, orthographic_to_world));
    object.number("near_clip", sensor.near_clip);
    const float near_clip = sensor.near_clip;
    const auto far_clip = find_near(sensor.far_clip, [&](float far) { return near_clip + (far - near_clip) == sensor.far_clip; });
    object.number("far_clip", required(far_clip, sensor));
    return *far_clip;
}

} // namespace

void write_sensor(ObjectWriter root, const Scene& scene)
{
    const Sensor& sensor = scene.sensor;
    const bool orthographic = sensor.projection == Projection::orthographic;
    const bool lens = sensor.aperture_radius > 0.0f;
    const char* type = orthographic ? (lens ? "telecentric" : "orthographic") : (lens ? "thinlens" : "perspective");
    ObjectWriter object = root.object("sensor", type);
    float far_clip = sensor.far_clip; // as it is written
    if (orthographic)
        far_clip = write_orthographic(object, sensor);
    else
        write_perspective(object, sensor);
    if (sensor.shutter.open != 0.0) object.number("shutter_open", sensor.shutter.open);
    if (sensor.shutter.close != 0.0) object.number("shutter_close", sensor.shutter.close);
    if (lens) object.number("aperture_radius", sensor.aperture_radius);
    if (sensor.focus_distance != far_clip) object.number("focus_distance", sensor.focus_distance);
    write_film(object, scene.film);
    if (scene.integrator.sample_count == 0) return; // no sampler
    ObjectWriter sampler = object.object("sampler", "independent");
    sampler.integer("sample_count", scene.integrator.sample_count);
    if (scene.integrator.seed != 0) sampler.integer("seed", static_cast<long long>(scene.integrator.seed));
}

} // namespace sundog
