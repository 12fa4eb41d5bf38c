// The camera: rays from the film, connections back to it, fields of view, focus, and the importance of pixels.
#include "scene/flat_scene.h"
#include "shared/ray.h"
#include "stages/camera_paths.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"
#include "support/double3.h"

#include <algorithm>
#include <numbers>
#include <random>

namespace sundog
{
namespace
{

using std::numbers::pi;

struct Connected {
    Ray ray;
    double film_x, film_y, importance;
    Vec3d lens;
    bool visible;
};

struct FilmPoint {
    float x, y;
    float lens_u, lens_v;
    float t; // where along the ray the point to connect lies
};

class CameraRays : public DeviceFixture
{
protected:
    // Sends rays through film points and connects the points at distance t along them to the camera again.
    std::vector<Connected> run(const Camera& camera, const std::vector<FilmPoint>& points)
    {
        const uint count = static_cast<uint>(points.size());
        std::vector<float> input;
        for (const FilmPoint& p : points) input.insert(input.end(), {p.x, p.y, p.lens_u, p.lens_v, p.t});
        const auto rays = allocate<Ray>(count);
        const auto output = allocate<float>(std::size_t(7) * count);
        kernel(camera)(count, camera, upload(input), count, rays, output);
        const auto made = rays.download();
        const auto values = output.download();
        std::vector<Connected> connected;
        for (std::size_t i = 0; i < count; ++i) {
            const float* v = &values[7 * i];
            connected.push_back({made[i], v[0], v[1], v[2], {v[3], v[4], v[5]}, v[6] != 0.0f});
        }
        return connected;
    }

    // Programs know the kind of camera (the stages' way) or read it from the record.
    bool kind_from_record = false;

private:
    Kernel kernel(const Camera& camera)
    {
        BuildOptions options;
        if (!kind_from_record) use_camera(options, camera);
        return test_kernel(source, options);
    }

    static constexpr const char* source = R"(
        #include "scene/camera_rays.h"
        __kernel void test(Camera camera, __global const float* input, uint count, __global Ray* rays, __global float* output)
        {
            uint i = get_global_id(0);
            if (i >= count) return;
            __global const float* in = input + 5u * i;
            const Ray ray = camera_ray(&camera, vload2(0, in), (float2)(in[2], in[3]));
            const CameraConnection c = connect_to_camera(&camera, unpack(ray.origin) + unpack(ray.direction) * in[4], (float2)(in[2], in[3]));
            rays[i] = ray;
            vstore2(c.film, 0, output + 7u * i);
            output[7u * i + 2u] = c.importance;
            vstore3(c.lens, 0, output + 7u * i + 3u);
            output[7u * i + 6u] = c.visible ? 1.0f : 0.0f;
        })";
};

struct Connection {
    double film_x, film_y, importance;
    Vec3d lens;
};

class CameraConnections : public DeviceFixture
{
protected:
    // Connects points to lens points: x, y, z, and two random numbers each.
    std::vector<Connection> connect(const Camera& camera, const std::vector<float>& input)
    {
        BuildOptions options;
        use_camera(options, camera);
        const Kernel kernel = test_kernel(R"(
            #include "scene/camera_rays.h"
            __kernel void test(Camera camera, __global const float* input, uint count, __global float* output)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                __global const float* in = input + 5u * i;
                const CameraConnection c = connect_to_camera(&camera, vload3(0, in), (float2)(in[3], in[4]));
                vstore2(c.film, 0, output + 6u * i);
                output[6u * i + 2u] = c.importance;
                vstore3(c.lens, 0, output + 6u * i + 3u);
            })",
                                          options);
        const uint count = static_cast<uint>(input.size() / 5);
        const auto output = allocate<float>(std::size_t(6) * count);
        kernel(count, camera, upload(input), count, output);
        const auto values = output.download();
        std::vector<Connection> connections;
        for (std::size_t i = 0; i < count; ++i) {
            const float* v = &values[6 * i];
            connections.push_back({v[0], v[1], v[2], {v[3], v[4], v[5]}});
        }
        return connections;
    }
};

Sensor tilted_sensor()
{
    Sensor sensor;
    const Frame3d frame({0.3, -0.2, 0.9});
    sensor.position = {1, 2, 3};
    sensor.axis_x = to_float(frame.s);
    sensor.axis_y = to_float(frame.t);
    sensor.axis_z = to_float(frame.n);
    sensor.fov_x = 0.9f;
    sensor.near_clip = 0.1f;
    sensor.far_clip = 100.0f;
    sensor.focus_distance = 4.0f;
    return sensor;
}

struct NamedSensor {
    const char* name;
    Sensor sensor;
};

// Every kind, with and without lens, each with its principal point off the film's centre.
std::vector<NamedSensor> all_sensors()
{
    Sensor pinhole = tilted_sensor();
    pinhole.principal_offset_x = 0.12f;
    pinhole.principal_offset_y = -0.07f;
    Sensor orthographic = pinhole;
    orthographic.projection = Projection::orthographic;
    orthographic.extent_x = 2.5f;
    orthographic.extent_y = 2.0f;
    Sensor thin_lens = pinhole, telecentric = orthographic;
    thin_lens.aperture_radius = telecentric.aperture_radius = 0.3f;
    return {{"perspective", tilted_sensor()}, {"shifted perspective", pinhole}, {"thin lens", thin_lens}, {"orthographic", orthographic}, {"telecentric", telecentric}};
}

Film wide_film()
{
    Film film;
    film.width = 320;
    film.height = 200;
    film.crop_x = 20;
    film.crop_y = 30;
    film.crop_width = 100;
    film.crop_height = 50;
    return film;
}

std::vector<FilmPoint> film_points(std::size_t count)
{
    std::vector<FilmPoint> points;
    // Rank-1 lattice: spread evenly over film, lens and depth.
    const auto part = [](double x) { return static_cast<float>(x - std::floor(x)); };
    for (std::size_t i = 0; i < count; ++i) {
        const double k = static_cast<double>(i) + 0.5;
        points.push_back({320.0f * part(k * 0.8566748838545029), 200.0f * part(k * 0.733891856627126), part(k * 0.6287067210378087),
                          part(k * 0.5385972572236101), 0.05f + 50.0f * part(k * 0.46140175)});
    }
    return points;
}

TEST_F(CameraRays, ConnectionsReturnToWhereTheRayCameFrom)
{
    for (const auto& [name, sensor] : all_sensors()) {
        SCOPED_TRACE(name);
        const auto points = film_points(5000);
        const auto connected = run(make_camera(sensor, wide_film()), points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            ASSERT_TRUE(connected[i].visible) << i;
            ASSERT_NEAR(connected[i].film_x, points[i].x, 0.01) << i;
            ASSERT_NEAR(connected[i].film_y, points[i].y, 0.01) << i;
            // The lens point lies on the ray's line, in the plane of the lens, within the aperture.
            const Vec3d lens = connected[i].lens - Vec3d(sensor.position);
            ASSERT_NEAR(dot(lens, Vec3d(sensor.axis_z)), 0.0, 1e-5);
            const double reach = sensor.projection == Projection::perspective ? sensor.aperture_radius : 10.0; // or all of the film
            ASSERT_LE(length(lens), reach + 1e-5);
            const Vec3d to_origin = Vec3d(connected[i].ray.origin) - connected[i].lens;
            ASSERT_NEAR(length(cross(to_origin, connected[i].ray.direction)), 0.0, 1e-5);
            ASSERT_NEAR(dot(to_origin, Vec3d(sensor.axis_z)), sensor.near_clip, 1e-5);
        }
    }
}

// What lies before the near or behind the far plane, or behind the camera, is not seen.
TEST_F(CameraRays, ClipPlanesBoundTheView)
{
    for (const auto& [name, sensor] : all_sensors()) {
        SCOPED_TRACE(name);
        const auto ends =
            run(make_camera(sensor, wide_film()), {{0, 0, 0, 0, 1e-3f}, {0, 0, 0, 0, -1e-3f}, {0, 0, 0, 0, -5.0f}, {0, 0, 0, 0, 1e4f}});
        EXPECT_TRUE(ends[0].visible);
        EXPECT_FALSE(ends[1].visible);
        EXPECT_FALSE(ends[2].visible);
        EXPECT_FALSE(ends[3].visible);
        const Vec3d end = Vec3d(ends[0].ray.origin) + Vec3d(ends[0].ray.direction) * ends[0].ray.t_max - Vec3d(sensor.position);
        EXPECT_NEAR(dot(end, Vec3d(sensor.axis_z)), sensor.far_clip, 1e-3) << "rays end at the far plane";
    }
}

// fov_x spans the film's width; x runs to the image's right, which is the camera's -x, y down.
TEST_F(CameraRays, FieldOfViewAndOrientation)
{
    const Sensor sensor = tilted_sensor();
    const auto corners =
        run(make_camera(sensor, wide_film()), {{160, 100, 0, 0, 1}, {0, 100, 0, 0, 1}, {320, 100, 0, 0, 1}, {160, 0, 0, 0, 1}});
    const auto local = [&](std::size_t i) {
        const Vec3d d = corners[i].ray.direction;
        return Vec3d(dot(d, Vec3d(sensor.axis_x)), dot(d, Vec3d(sensor.axis_y)), dot(d, Vec3d(sensor.axis_z)));
    };
    EXPECT_NEAR(length(local(0) - Vec3d(0, 0, 1)), 0.0, 1e-6);
    EXPECT_NEAR(std::atan2(local(1).x, local(1).z), 0.45, 1e-6);
    EXPECT_NEAR(std::atan2(local(2).x, local(2).z), -0.45, 1e-6);
    EXPECT_NEAR(local(3).y / local(3).z, std::tan(0.45) * 200.0 / 320.0, 1e-6);
    for (const auto& c : corners) EXPECT_NEAR(length(Vec3d(c.ray.direction)), 1.0, 1e-6);
}

// The film of an orthographic camera is extent_x to each side of its axis, and its rays are parallel.
TEST_F(CameraRays, OrthographicExtent)
{
    Sensor sensor = tilted_sensor();
    sensor.projection = Projection::orthographic;
    sensor.extent_x = 3.0f;
    sensor.extent_y = 4.0f;
    const auto local = [&](const Vec3d& d) {
        return Vec3d(dot(d, Vec3d(sensor.axis_x)), dot(d, Vec3d(sensor.axis_y)), dot(d, Vec3d(sensor.axis_z)));
    };
    const auto rays = run(make_camera(sensor, wide_film()), {{160, 100, 0, 0, 1}, {0, 0, 0, 0, 1}, {320, 200, 0, 0, 1}});
    const Vec3d corners[] = {{0, 0, 0.1}, {3, 2.5, 0.1}, {-3, -2.5, 0.1}}; // extent_y 200 / 320 = 2.5; the near plane
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(length(local(rays[i].ray.direction) - Vec3d(0, 0, 1)), 0.0, 1e-6);
        EXPECT_NEAR(length(local(Vec3d(rays[i].ray.origin) - Vec3d(sensor.position)) - corners[i]), 0.0, 2e-6);
    }
}

// The axis meets the film at its centre less the offset, as in Mitsuba 3: x / z = tan_x (1 - 2 (u + offset)).
TEST_F(CameraRays, PrincipalPointOffset)
{
    Sensor sensor = tilted_sensor();
    sensor.principal_offset_x = 0.1f;
    sensor.principal_offset_y = 0.25f;
    const auto rays = run(make_camera(sensor, wide_film()), {{128, 50, 0, 0, 1}, {0, 0, 0, 0, 1}});
    EXPECT_NEAR(length(Vec3d(rays[0].ray.direction) - Vec3d(sensor.axis_z)), 0.0, 1e-6);
    const Vec3d d = rays[1].ray.direction;
    EXPECT_NEAR(dot(d, Vec3d(sensor.axis_x)) / dot(d, Vec3d(sensor.axis_z)), std::tan(0.45) * 0.8, 1e-6);
    EXPECT_NEAR(dot(d, Vec3d(sensor.axis_y)) / dot(d, Vec3d(sensor.axis_z)), std::tan(0.45) * 200.0 / 320.0 * 0.5, 1e-6);
}

// Whatever the lens point, rays of one film point meet in the plane of focus.
TEST_F(CameraRays, LensesFocus)
{
    for (const auto& [name, sensor] : all_sensors()) {
        if (sensor.aperture_radius == 0.0f) continue;
        SCOPED_TRACE(name);
        std::vector<FilmPoint> points = film_points(200);
        for (FilmPoint& p : points) p.x = 40.0f, p.y = 150.0f;
        Vec3d focus;
        double spread = 0.0;
        Vec3d first;
        for (const Connected& c : run(make_camera(sensor, wide_film()), points)) {
            const Vec3d d = c.ray.direction;
            const double t = (sensor.focus_distance - sensor.near_clip) / dot(d, Vec3d(sensor.axis_z));
            const Vec3d at = Vec3d(c.ray.origin) + d * t;
            if (length(focus) == 0.0) focus = at, first = c.lens;
            ASSERT_NEAR(length(at - focus), 0.0, 2e-5);
            spread = std::max(spread, length(c.lens - first));
        }
        EXPECT_GT(spread, sensor.aperture_radius) << "the rays leave from all of the lens";
    }
}

// 1 / importance is a pixel's solid angle: it adds up to that of the film's pyramid, 4 asin(a b / sqrt((1 + a^2)(1 + b^2))).
TEST_F(CameraRays, ImportanceIsOneOverThePixelsSolidAngle)
{
    const Sensor sensor = tilted_sensor();
    std::vector<FilmPoint> points;
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 320; ++x) points.push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 0, 0, 2});
    double solid_angle = 0.0;
    for (const Connected& c : run(make_camera(sensor, wide_film()), points)) solid_angle += 1.0 / c.importance;
    const double a = std::tan(0.45), b = a * 200.0 / 320.0;
    EXPECT_NEAR(solid_angle, 4.0 * std::asin(a * b / std::sqrt((1.0 + a * a) * (1.0 + b * b))), 1e-5);
}

// Points spread evenly over a plane across the axis, seen from even lens points, are even on the film, whatever is in
// focus: a pixel's counts follow the part of the plane that it sees.
TEST_F(CameraConnections, FilmDensityOfAPlane)
{
    constexpr int count = 200'000, columns = 10, rows = 8;
    constexpr double z = 7.0; // out of focus
    for (const auto& [name, sensor] : all_sensors()) {
        SCOPED_TRACE(name);
        const Camera camera = make_camera(sensor, wide_film());
        const double widen = camera.kind == CAMERA_PERSPECTIVE ? z : 1.0; // of the film, at the plane
        const double margin = 1.0; // more than the lens can look beside the film: 0.3 (z / 4 - 1) or 0.3
        const double half_x = widen * camera.half_width + margin, half_y = widen * camera.half_height + margin;
        std::vector<float> input;
        std::mt19937 random(42);
        std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
        for (int i = 0; i < count; ++i) {
            const double x = widen * camera.shift_x + half_x * (2.0 * uniform(random) - 1.0);
            const double y = widen * camera.shift_y + half_y * (2.0 * uniform(random) - 1.0);
            const Vec3 p = sensor.position + sensor.axis_x * static_cast<float>(x) + sensor.axis_y * static_cast<float>(y) + sensor.axis_z * static_cast<float>(z);
            input.insert(input.end(), {p.x, p.y, p.z, uniform(random), uniform(random)});
        }
        std::vector<double> observed(columns * rows + 1, 0.0);
        for (const Connection& c : connect(camera, input)) {
            const double column = std::floor(c.film_x * columns / 320.0), row = std::floor(c.film_y * rows / 200.0);
            const bool inside = column >= 0 && column < columns && row >= 0 && row < rows;
            observed[inside ? static_cast<std::size_t>(row * columns + column) : columns * rows] += 1.0;
        }
        const double film_part = widen * widen * camera.half_width * camera.half_height / (half_x * half_y);
        std::vector<double> expected(observed.size(), count * film_part / (columns * rows));
        expected.back() = count * (1.0 - film_part);
        EXPECT_TRUE(follows(observed, expected, 5));
    }
}

// importance * cos / d^2 is the area of film (pixels^2) that a unit of surface takes when seen from one lens point:
// the determinant of the derivative of the film position, here by central differences on a tilted surface. They are
// off by (step / z)^2 at most, 1e-4, and rounding adds 1e-4 (film positions have errors of 3e-5 pixels, steps a few pixels).
TEST_F(CameraConnections, ImportanceIsTheJacobianFromSurfaceToFilm)
{
    constexpr double step = 0.05;
    const Frame3d surface({0.5, 0.3, -0.8});
    for (const auto& [name, sensor] : all_sensors()) {
        SCOPED_TRACE(name);
        std::vector<float> input;
        std::vector<Vec3d> points;
        for (const FilmPoint& p : film_points(200)) {
            const double z = 6.0 + 10.0 * p.lens_v;
            const Vec3d point = Vec3d(sensor.position) + Vec3d(sensor.axis_z) * z + Vec3d(sensor.axis_x) * (p.x / 160.0 - 1.0) + Vec3d(sensor.axis_y) * (p.y / 100.0 - 1.0);
            points.push_back(point);
            for (const Vec3d& offset : {Vec3d(0, 0, 0), surface.s * step, surface.s * -step, surface.t * step, surface.t * -step}) {
                const Vec3 at = to_float(point + offset);
                input.insert(input.end(), {at.x, at.y, at.z, p.lens_u, p.lens_v});
            }
        }
        const auto c = connect(make_camera(sensor, wide_film()), input);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto along = [&](std::size_t plus, double Connection::*axis) { return (c[5 * i + plus].*axis - c[5 * i + plus + 1].*axis) / (2.0 * step); };
            const double determinant =
                along(1, &Connection::film_x) * along(3, &Connection::film_y) - along(3, &Connection::film_x) * along(1, &Connection::film_y);
            const Vec3d to_lens = c[5 * i].lens - points[i];
            const double distance = length(to_lens);
            const double density = c[5 * i].importance * std::abs(dot(to_lens, surface.n)) / (distance * distance * distance);
            ASSERT_NEAR(density, std::abs(determinant), 1e-3 * density) << i;
        }
    }
}

// A program that reads the camera's kind from the record does the same as one built for it.
TEST_F(CameraRays, KindOfTheProgramAndOfTheRecordAgree)
{
    for (const auto& [name, sensor] : all_sensors()) {
        SCOPED_TRACE(name);
        const Camera camera = make_camera(sensor, wide_film());
        kind_from_record = false;
        const auto built = run(camera, film_points(100));
        kind_from_record = true;
        const auto read = run(camera, film_points(100));
        for (std::size_t i = 0; i < built.size(); ++i) {
            ASSERT_NEAR(length(Vec3d(built[i].ray.origin) - Vec3d(read[i].ray.origin)), 0.0, 1e-6);
            ASSERT_NEAR(length(Vec3d(built[i].ray.direction) - Vec3d(read[i].ray.direction)), 0.0, 1e-6);
            ASSERT_NEAR(built[i].importance, read[i].importance, 1e-5 * read[i].importance);
        }
    }
}

} // namespace
} // namespace sundog
