#include "import/sensor_import.h"

#include "import/animation_import.h"
#include "import/limits.h"
#include "import/number_text.h"
#include "import/text_file.h"
#include "math/direction.h"
#include "scene/sensor_pose.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace sundog
{

namespace
{

constexpr double degree = std::numbers::pi / 180.0;
constexpr double largest_offset = 1e3;   // of the film's middle from the axis, in films
constexpr double largest_aperture = 1e5; // in distances to the plane in focus

double parse_focal_length(ObjectReader& reader)
{
    std::string text = reader.text("focal_length", "50mm");
    std::string_view number(text);
    if (number.ends_with("mm")) number.remove_suffix(2);
    const auto millimetres = parse_number(number);
    if (!millimetres || !(*millimetres > 0.0))
        throw SceneError(reader.where_of("focal_length"), "focal_length must be of the form 50mm, got '" + text + "'");
    return *millimetres;
}

// The axis to which the field of view applies: x, y or diagonal.
std::string read_fov_axis(ObjectReader& reader, double aspect)
{
    const std::string axis = reader.text("fov_axis", "x");
    if (axis == "smaller") return aspect > 1.0 ? "y" : "x";
    if (axis == "larger") return aspect > 1.0 ? "x" : "y";
    if (axis == "x" || axis == "y" || axis == "diagonal") return axis;
    throw SceneError(reader.where_of("fov_axis"), "fov_axis must be x, y, diagonal, smaller or larger, got '" + axis + "'");
}

double read_tangent(ObjectReader& reader, double aspect)
{
    const double diagonal_to_x = 1.0 / std::sqrt(1.0 + 1.0 / (aspect * aspect));
    if (!reader.has("fov")) {
        // The film of a 35 mm camera is 36 x 24 mm; the focal length refers to its diagonal.
        const double diagonal = std::hypot(36.0, 24.0) / (2.0 * parse_focal_length(reader));
        reader.ignore("fov_axis", "it needs fov");
        return diagonal * diagonal_to_x;
    }
    if (reader.has("focal_length")) throw SceneError(reader.where_of("focal_length"), "give a sensor either fov or focal_length, not both");
    const double fov = reader.number("fov", 0.0);
    if (!(fov > 0.0 && fov < 180.0))
        throw SceneError(reader.where_of("fov"), "fov must be in (0, 180) degrees, got " + std::to_string(fov));
    const double tangent = std::tan(0.5 * degree * fov);
    const std::string axis = read_fov_axis(reader, aspect);
    if (axis == "y") return tangent * aspect;
    if (axis == "diagonal") return tangent * diagonal_to_x;
    return tangent;
}

} // namespace

double read_tan_half_x(ObjectReader& reader, double aspect)
{
    const double tangent = read_tangent(reader, aspect);
    if (tangent >= narrowest_tangent && tangent <= widest_tangent) return tangent;
    const char* name = reader.has("fov") ? "fov" : "focal_length";
    throw SceneError(reader.where_of(name), tangent < widest_tangent
                                                ? "the field of view is too narrow for 32-bit numbers: make it at least 1e-5 degrees wide"
                                                : "the field of view is too wide for 32-bit numbers: make it at most 179.99999 degrees");
}

namespace
{

void read_shutter(ObjectReader& reader, Sensor& sensor)
{
    sensor.shutter = {reader.number("shutter_open", 0.0), reader.number("shutter_close", 0.0)};
    const auto [open, close] = sensor.shutter;
    if (open <= close) return;
    throw SceneError(reader.where_of(reader.has("shutter_close") ? "shutter_close" : "shutter_open"),
                     "the shutter closes (shutter_close, " + number_text(close) + ", default 0) before it opens (shutter_open, " +
                         number_text(open) + "): exchange the two, or give both the same time for a still");
}

Transform read_key(const Transform& to_world, const SourceLocation& where)
{
    Sensor sensor;
    set_pose(to_world, sensor);
    check_position(sensor.position, where, "the sensor");
    return pose_of(sensor);
}

// Where the sensor is and, if it moves, where it goes.
void read_pose(const AnimatedTransform& to_world, const SourceLocation& where, Sensor& sensor)
{
    std::vector<TransformKey> keys = to_world.keys();
    for (TransformKey& key : keys) key.transform = read_key(key.transform, where);
    const AnimatedTransform motion(keys);
    set_pose(motion.at(sensor.shutter.open), sensor);
    if (motion.moves(sensor.shutter.open, sensor.shutter.close)) sensor.motion = motion;
}

void read_clip_planes(ObjectReader& reader, Sensor& sensor)
{
    sensor.near_clip = static_cast<float>(reader.positive("near_clip", 1e-2));
    sensor.far_clip = static_cast<float>(reader.positive("far_clip", 1e4));
    if (!(sensor.near_clip < sensor.far_clip)) throw SceneError(reader.where_of("near_clip"), "near_clip must be smaller than far_clip");
    sensor.focus_distance = static_cast<float>(reader.positive("focus_distance", sensor.far_clip));
}

void read_perspective(ObjectReader& reader, const SceneIndex& index, const Film& film, Sensor& sensor)
{
    const AnimatedTransform to_world = read_to_world(reader, sensor.shutter).relative_to(index.origins().world.place);
    const SourceLocation where = reader.where_of("to_world");
    bool scaled = false;
    for (const TransformKey& key : to_world.keys()) {
        const auto scale = key.transform.uniform_scale();
        if (!scale) throw SceneError(where, "to_world of a sensor must not shear or scale unevenly: use translate, rotate and lookat");
        scaled = scaled || std::abs(*scale - 1.0) > 1e-3;
    }
    if (scaled) index.warn(where, "the scale in to_world of a sensor is ignored", WarningKind::ignored);
    read_pose(to_world, where, sensor);
    sensor.fov_x = static_cast<float>(2.0 * std::atan(read_tan_half_x(reader, static_cast<double>(film.width) / film.height)));
    sensor.principal_offset_x = static_cast<float>(reader.number_between("principal_point_offset_x", 0.0, -largest_offset, largest_offset));
    sensor.principal_offset_y = static_cast<float>(reader.number_between("principal_point_offset_y", 0.0, -largest_offset, largest_offset));
}

// Lengths of to_world's axes, which must be perpendicular.
Vec3 orthogonal_scale(const Transform& to_world, const SourceLocation& where)
{
    const Vec3 x = to_world.vector({1, 0, 0}), y = to_world.vector({0, 1, 0}), z = to_world.vector({0, 0, 1});
    const Vec3 scale{direction_and_length(x).length, direction_and_length(y).length, direction_and_length(z).length};
    if (!std::isnormal(scale.x) || !std::isnormal(scale.y) || !std::isnormal(scale.z))
        throw SceneError(where, "the scale in to_world of the sensor is out of range of 32-bit numbers");
    constexpr float tolerance = 1e-3f; // of the cosines between axes
    if (std::abs(dot(x, y)) > tolerance * scale.x * scale.y || std::abs(dot(y, z)) > tolerance * scale.y * scale.z ||
        std::abs(dot(z, x)) > tolerance * scale.z * scale.x)
        throw SceneError(where, "to_world of an orthographic sensor must not shear: scale first, then rotate, lookat and translate");
    return scale;
}

// The film spans [-1, 1] along x of to_world, and along y what makes pixels square where to_world does not stretch
// one axis more than the other.
void read_orthographic(ObjectReader& reader, const SceneIndex& index, Sensor& sensor)
{
    const AnimatedTransform to_world = read_to_world(reader, sensor.shutter).relative_to(index.origins().world.place);
    const SourceLocation where = reader.where_of("to_world");
    sensor.projection = Projection::orthographic;
    const std::vector<TransformKey> keys = to_world.keys();
    const Vec3 scale = orthogonal_scale(keys.front().transform, where);
    for (const TransformKey& key : keys) {
        const Vec3 ratio = orthogonal_scale(key.transform, where) * Vec3{1 / scale.x, 1 / scale.y, 1 / scale.z} - Vec3{1, 1, 1};
        if (std::max({std::abs(ratio.x), std::abs(ratio.y), std::abs(ratio.z)}) > 1e-3f)
            throw SceneError(where,
                             "the film of an orthographic sensor cannot grow or shrink while it moves: give all keys the same scale");
    }
    read_pose(to_world, where, sensor);
    sensor.extent_x = scale.x;
    sensor.extent_y = scale.y;
    const float scale_z = scale.z;
    // Mitsuba 3 has the near plane in camera space, and the far one where the unscaled distance between them ends;
    // 0.6 has both in world space.
    if (!index.legacy()) {
        const float depth = sensor.far_clip - sensor.near_clip;
        sensor.near_clip *= scale_z;
        sensor.far_clip = sensor.near_clip + depth;
    }
}

void read_lens(ObjectReader& reader, const SceneIndex& index, Sensor& sensor)
{
    if (!reader.has("aperture_radius") && reader.type() == "thinlens")
        throw SceneError(reader.where(), "thinlens needs a <float name=\"aperture_radius\">");
    const double radius = reader.number("aperture_radius", 0.0);
    if (radius < 0.0) throw SceneError(reader.where_of("aperture_radius"), "aperture_radius must be >= 0");
    if (radius > largest_coordinate || radius > largest_aperture * static_cast<double>(sensor.focus_distance))
        throw SceneError(reader.where_of("aperture_radius"), "aperture_radius must be at most 1e5 times the focus_distance, and 1e12");
    if (radius == 0.0) index.warn(reader.where_of("aperture_radius"), "aperture_radius is 0: all is in focus");
    sensor.aperture_radius = static_cast<float>(radius);
}

void read_sampler(ObjectReader& sensor, const SceneIndex& index, IntegratorRequest& request)
{
    const auto sampler = sensor.single("sampler");
    if (!sampler) return;
    ObjectReader reader(*sampler->object, index);
    const std::string type = reader.type();
    if (type != "independent")
        index.warn(reader.where(), "sampler '" + type + "' is ignored: the method chooses its random numbers", WarningKind::ignored);
    request.sample_count = reader.integer("sample_count", 4);
    if (request.sample_count < 1) throw SceneError(reader.where_of("sample_count"), "sample_count must be >= 1");
    const int seed = reader.integer("seed", 0);
    if (seed < 0) throw SceneError(reader.where_of("seed"), "seed must be >= 0");
    request.seed = static_cast<std::uint64_t>(seed);
    for (const char* name : {"jitter", "dimension", "scramble"}) reader.ignore(name, "the method chooses its random numbers");
    reader.finish();
}

// Says, for sensors that make no image of the scene or one that is not supported, what to use instead.
[[noreturn]] void refuse_type(const ObjectReader& reader)
{
    constexpr std::pair<const char*, const char*> cures[] = {
        {"radiancemeter", "it measures a single ray: use perspective with a film of one pixel and a small fov"},
        {"irradiancemeter",
         "it measures a shape: look at it with orthographic; the radiance of a white diffuse surface is its irradiance / pi"},
        {"fluencemeter", "it measures a point: use perspective sensors of fov 90 along the six axes"},
        {"distant", "use orthographic, which looks along one direction too, scaled to the size of the scene"},
        {"hdistant", "render one orthographic sensor for each direction"},
        {"batch", "render each of its sensors by a scene file of its own, which can <include> the rest"},
        {"spherical", "use perspective sensors of fov 90 along the six axes"},
        {"perspective_rdist", "use perspective and distort the image afterwards"},
        {"microphone", "only light is rendered"},
    };
    const std::string type = reader.type();
    for (const auto& [name, cure] : cures)
        if (type == name) throw SceneError(reader.where(), "sensor plugin '" + type + "' is not supported: " + cure);
    reader.unsupported("perspective, thinlens, orthographic, telecentric");
}

void refuse_unsupported(ObjectReader& reader)
{
    reader.refuse("srf", "remove it");
}

} // namespace

void import_sensor(const XmlElement& element, const SceneIndex& index, Scene& scene)
{
    ObjectReader reader(element, index);
    const std::string type = reader.type();
    const bool perspective = type == "perspective" || type == "thinlens";
    if (!perspective && type != "orthographic" && type != "telecentric") refuse_type(reader);

    if (const auto film = reader.single("film")) {
        ObjectReader film_reader(*film->object, index);
        scene.film = import_film(film_reader);
    } else {
        scene.film.where = element.where;
    }
    Sensor& sensor = scene.sensor;
    sensor.where = element.where;
    read_clip_planes(reader, sensor);
    read_shutter(reader, sensor);
    if (perspective)
        read_perspective(reader, index, scene.film, sensor);
    else
        read_orthographic(reader, index, sensor);
    if (type == "thinlens" || type == "telecentric") read_lens(reader, index, sensor);
    read_sampler(reader, index, scene.integrator);
    refuse_unsupported(reader);
    reader.finish();
}

} // namespace sundog
