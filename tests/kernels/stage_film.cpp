// The film: accumulation without drift, samples that are not finite, the order of paths, and first-hit channels.
#include "film/device_film.h"
#include "stages/camera_paths.h"
#include "support/device_fixture.h"
#include "support/double3.h"
#include "support/scene_builder.h"

#include <numeric>

namespace sundog
{
namespace
{

class FilmStage : public DeviceFixture
{
};

// 10^5 iterations of values that a plain float sum would lose: each channel against double sums.
TEST_F(FilmStage, AccumulatesWithoutDrift)
{
    constexpr int width = 8, height = 2, iterations = 100'000, variants = 5;
    // By variant: rounding in every digit, small after large, alternating magnitudes.
    const float values[variants][3] = {
        {0.1f, 1e4f, 1e-6f}, {1.0f / 3.0f, 1e-3f, 3e5f}, {0.7f, 0.1f, 1e-6f}, {1e-7f, 2.5e-4f, 7e-7f}, {0.3f, 17.0f, 123.456f}};
    DeviceFilm film(device_, width, height);
    std::vector<Buffer<Vec3>> radiance;
    std::vector<Vec3> host[variants];
    for (int variant = 0; variant < variants; ++variant) {
        for (int pixel = 0; pixel < width * height; ++pixel) {
            const float* v = values[(variant + pixel) % variants];
            host[variant].push_back({v[0], v[1], v[2]});
        }
        radiance.push_back(upload(host[variant]));
    }
    for (int i = 0; i < iterations; ++i) film.accumulate(radiance[static_cast<std::size_t>(i % variants)]);

    const Image image = film.resolve();
    ASSERT_EQ(film.iterations(), static_cast<std::uint64_t>(iterations));
    EXPECT_EQ(film.invalid_samples(), 0u);
    for (std::size_t path = 0; path < film.pixel_count(); ++path) {
        const float* pixel = &image.pixels[film.pixel_of_path(path) * image.channels.size()];
        for (int channel = 0; channel < 3; ++channel) {
            double mean = 0.0, variance = 0.0;
            const auto value = [&](int variant) {
                return static_cast<double>(channel == 0   ? host[variant][path].x
                                           : channel == 1 ? host[variant][path].y
                                                          : host[variant][path].z);
            };
            for (int variant = 0; variant < variants; ++variant) mean += value(variant) / variants;
            for (int variant = 0; variant < variants; ++variant)
                variance += std::pow(value(variant) - mean, 2) / variants * iterations / (iterations - 1.0);
            ASSERT_NEAR(pixel[channel] / mean, 1.0, 2e-7) << "pixel " << path << ", channel " << channel;
            ASSERT_NEAR(pixel[3 + channel] / variance, 1.0, 1e-6) << "variance of pixel " << path << ", channel " << channel;
        }
    }
}

TEST_F(FilmStage, CountsAndLeavesOutWhatIsNotFinite)
{
    DeviceFilm film(device_, 3, 2);
    film.accumulate(upload(std::vector<Vec3>(6, {1, 2, 3})));
    film.accumulate(
        upload(std::vector<Vec3>{{1, 2, 3}, {NAN, 0, 0}, {0, INFINITY, 0}, {0, 0, -INFINITY}, {1, 2, 3}, {INFINITY, -INFINITY, 0}}));
    EXPECT_EQ(film.invalid_samples(), 4u);
    const Image image = film.resolve();
    for (const float value : image.pixels) EXPECT_TRUE(std::isfinite(value));
    EXPECT_EQ(image.pixels[0], 1.0f);
}

// Paths go through the image by tiles: device and host agree, and every pixel has one path.
TEST_F(FilmStage, PathsAndPixelsCorrespond)
{
    const Kernel kernel = test_kernel(R"(
        #include "scene/camera_rays.h"
        __kernel void test(uint width, uint height, __global uint* pixels, __global uint* paths)
        {
            uint path = get_global_id(0);
            if (path >= width * height) return;
            const uint2 pixel = pixel_of_path(path, width, height);
            pixels[path] = pixel.y * width + pixel.x;
            paths[path] = pixel.x < width && pixel.y < height ? path_of_pixel(pixel, width, height) : 0xffffffffu;
        })");
    const std::pair<uint, uint> sizes[] = {{1, 1}, {7, 5}, {8, 8}, {9, 17}, {64, 3}, {3, 64}, {100, 75}, {257, 129}, {16, 9}};
    for (const auto& [width, height] : sizes) {
        SCOPED_TRACE(testing::Message() << width << " x " << height);
        const uint count = width * height;
        const auto pixels = allocate<uint>(count), paths = allocate<uint>(count);
        kernel(count, width, height, pixels, paths);
        std::vector<uint> identity(count), of_path = pixels.download();
        std::iota(identity.begin(), identity.end(), 0u);
        EXPECT_EQ(paths.download(), identity) << "path_of_pixel is not the inverse";
        const DeviceFilm film(device_, static_cast<int>(width), static_cast<int>(height));
        for (uint path = 0; path < count; ++path) ASSERT_EQ(film.pixel_of_path(path), of_path[path]);
        std::sort(of_path.begin(), of_path.end());
        EXPECT_EQ(of_path, identity) << "a pixel without a path, or with two";
    }
}

// Camera paths start in their pixel's filter; albedo, normal and depth are means of what they see first.
TEST_F(FilmStage, FirstHitsAreMeans)
{
    // A red floor at z = 0 fills the left of the view, the background its right.
    SceneBuilder builder;
    const uint red = builder.bsdf(DiffuseBsdf{{0.75f, 0.25f, 0.125f}});
    builder.shape(parallelogram({0, -50, 0}, {50, 0, 0}, {0, 100, 0}), red).emitter(PointEmitter{{0, 0, 5}, {1, 1, 1}});
    Sensor sensor; // at the origin it looks along +z with +x to the left
    sensor.position = {0, 0, 10};
    sensor.axis_x = {1, 0, 0};
    sensor.axis_y = {0, -1, 0};
    sensor.axis_z = {0, 0, -1};
    Film film_description;
    film_description.width = film_description.crop_width = 12;
    film_description.height = film_description.crop_height = 6;
    film_description.filter = {FilterKind::box, 0.5f, 0.5f, 0.0f, 0.0f};
    const DeviceScene scene(device_, builder.scene);
    const Camera camera = make_camera(sensor, film_description);
    CameraPaths paths(device_, camera, make_pixel_filter(film_description.filter), SamplerKind::independent);
    PathPool pool(device_, scene, paths.count());
    DeviceFilm film(device_, 12, 6);
    constexpr std::uint64_t iterations = 8;
    std::vector<double> depths(paths.count(), 0.0);
    for (std::uint64_t i = 0; i < iterations; ++i) {
        paths.start(scene, pool, sampler_key(1, i));
        paths.record_first_hits(scene, pool, i, film.first_hits);
        const auto rays = pool.rays.download();
        const auto states = pool.paths.download();
        const auto hits = pool.hits.download();
        const auto active = pool.active().download(0, paths.count());
        for (std::size_t path = 0; path < paths.count(); ++path) {
            ASSERT_EQ(active[path], path);
            ASSERT_EQ(states[path].depth, 1u);
            ASSERT_EQ(states[path].throughput.x, 1.0f);
            // Projected back, the ray lies in its pixel.
            const Vec3d d = rays[path].direction;
            const double x = 6.0 * (1.0 - dot(d, Vec3d(sensor.axis_x)) / dot(d, Vec3d(sensor.axis_z)) / camera.half_width);
            const double y = 3.0 * (1.0 - dot(d, Vec3d(sensor.axis_y)) / dot(d, Vec3d(sensor.axis_z)) / camera.half_height);
            const std::size_t pixel = film.pixel_of_path(path);
            ASSERT_NEAR(x, static_cast<double>(pixel % 12) + 0.5, 0.50001);
            ASSERT_NEAR(y, static_cast<double>(pixel / 12) + 0.5, 0.50001);
            if (hits[path].primitive == NO_PRIMITIVE) continue;
            const Vec3d at = Vec3d(rays[path].origin) + d * hits[path].t;
            depths[path] +=
                length(at - Vec3d(sensor.position)) / static_cast<double>(iterations); // from the camera, not from its near plane
        }
    }
    for (const Vec3& radiance : paths.radiance.download()) EXPECT_EQ(radiance.x, 0.0f);
    const auto first = film.first_hits.download();
    for (std::size_t path = 0; path < first.size(); ++path) {
        const std::size_t column = film.pixel_of_path(path) % 12;
        const bool floor = column < 6;
        EXPECT_NEAR(first[path].albedo.x, floor ? 0.75 : 0.0, 1e-6) << column;
        EXPECT_NEAR(first[path].albedo.z, floor ? 0.125 : 0.0, 1e-6);
        EXPECT_NEAR(first[path].normal.z, floor ? 1.0 : 0.0, 1e-6);
        EXPECT_NEAR(first[path].depth, depths[path], 1e-4);
    }
}

} // namespace
} // namespace sundog
