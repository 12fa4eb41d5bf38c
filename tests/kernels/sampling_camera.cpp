// The camera: rays from the film, connections back to it, fields of view, focus, and the importance of pixels.
#include "scene/flat_scene.h"
#include "shared/ray.h"
#include "support/device_fixture.h"
#include "support/double3.h"

#include <numbers>

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
        kernel_(count, camera, upload(input), count, rays, output);
        const auto made = rays.download();
        const auto values = output.download();
        std::vector<Connected> connected;
        for (std::size_t i = 0; i < count; ++i) {
            const float* v = &values[7 * i];
            connected.push_back({made[i], v[0], v[1], v[2], {v[3], v[4], v[5]}, v[6] != 0.0f});
        }
        return connected;
    }

private:
    Kernel kernel_ = test_kernel(R"(
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
        })");
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
    for (const float aperture : {0.0f, 0.3f}) {
        Sensor sensor = tilted_sensor();
        sensor.aperture_radius = aperture;
        const auto points = film_points(5000);
        const auto connected = run(make_camera(sensor, wide_film()), points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            ASSERT_TRUE(connected[i].visible) << i;
            ASSERT_NEAR(connected[i].film_x, points[i].x, 0.01) << "aperture " << aperture << ", point " << i;
            ASSERT_NEAR(connected[i].film_y, points[i].y, 0.01) << "aperture " << aperture << ", point " << i;
            // The lens point lies on the ray's line, in the plane of the lens, within the aperture.
            const Vec3d lens = connected[i].lens - Vec3d(sensor.position);
            ASSERT_NEAR(dot(lens, Vec3d(sensor.axis_z)), 0.0, 1e-5);
            ASSERT_LE(length(lens), aperture + 1e-5);
            const Vec3d to_origin = Vec3d(connected[i].ray.origin) - connected[i].lens;
            ASSERT_NEAR(length(cross(to_origin, connected[i].ray.direction)), 0.0, 1e-5);
            ASSERT_NEAR(dot(to_origin, Vec3d(sensor.axis_z)), sensor.near_clip, 1e-5);
        }
    }
}

// What lies before the near or behind the far plane, or behind the camera, is not seen.
TEST_F(CameraRays, ClipPlanesBoundTheView)
{
    const Sensor sensor = tilted_sensor();
    const auto ends =
        run(make_camera(sensor, wide_film()), {{0, 0, 0, 0, 1e-3f}, {0, 0, 0, 0, -1e-3f}, {0, 0, 0, 0, -5.0f}, {0, 0, 0, 0, 1e4f}});
    EXPECT_TRUE(ends[0].visible);
    EXPECT_FALSE(ends[1].visible);
    EXPECT_FALSE(ends[2].visible);
    EXPECT_FALSE(ends[3].visible);
    const Vec3d end = Vec3d(ends[0].ray.origin) + Vec3d(ends[0].ray.direction) * ends[0].ray.t_max - Vec3d(sensor.position);
    EXPECT_NEAR(dot(end, Vec3d(sensor.axis_z)), sensor.far_clip, 1e-3) << "rays end at the far plane";
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

// Whatever the lens point, rays of one film point meet in the plane of focus.
TEST_F(CameraRays, ThinLensFocuses)
{
    Sensor sensor = tilted_sensor();
    sensor.aperture_radius = 0.5f;
    std::vector<FilmPoint> points = film_points(200);
    for (FilmPoint& p : points) p.x = 40.0f, p.y = 150.0f;
    Vec3d focus;
    for (const Connected& c : run(make_camera(sensor, wide_film()), points)) {
        const Vec3d d = c.ray.direction;
        const double t = (sensor.focus_distance - sensor.near_clip) / dot(d, Vec3d(sensor.axis_z));
        const Vec3d at = Vec3d(c.ray.origin) + d * t;
        if (length(focus) == 0.0) focus = at;
        ASSERT_NEAR(length(at - focus), 0.0, 2e-5);
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

} // namespace
} // namespace sundog
