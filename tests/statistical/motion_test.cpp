// Motion blur: images against analytic exposures, against stills at the times of the passes, and resumed ones.
#include "scene/sensor_pose.h"
#include "support/cornell_scene.h"
#include "support/instanced_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <unistd.h>

namespace sundog::test
{
namespace
{

using Keys = std::vector<TransformKey>;

AnimatedTransform slide(Double3 from, Double3 to, double start = 0.0, double end = 1.0)
{
    return AnimatedTransform(Keys{{start, Transform::translate(from)}, {end, Transform::translate(to)}});
}

// Puts the shape into a group of its own and moves it.
void add_moving(Scene& scene, const ShapeDescription& shape, const AnimatedTransform& to_world)
{
    scene.shapes.push_back(shape);
    make_instances(scene, scene.shapes.size() - 1, {Transform()});
    scene.instances.back().to_world = to_world;
}

void move_camera(Scene& scene, const Keys& offsets)
{
    Keys keys = offsets;
    for (TransformKey& key : keys) key.transform = key.transform * pose_of(scene.sensor);
    scene.sensor.motion = AnimatedTransform(keys);
    set_pose(scene.sensor.motion->at(scene.sensor.shutter.open), scene.sensor);
}

// Orthographic, [-1, 1]^2, looking down: the left of the image is at -x.
Scene scene_from_above(int size)
{
    Scene scene;
    scene.sensor.projection = Projection::orthographic;
    scene.sensor.position = {0, 5, 0};
    scene.sensor.axis_x = {-1, 0, 0};
    scene.sensor.axis_y = {0, 0, -1};
    scene.sensor.axis_z = {0, -1, 0};
    scene.film.width = scene.film.height = scene.film.crop_width = scene.film.crop_height = size;
    scene.film.filter = {FilterKind::box, 0.5f, 0.5f, 0, 0};
    return scene;
}

constexpr int size = 16;
constexpr std::uint64_t passes = 256;

// A black disc of radius r crosses a white frame, all of it within the shutter's time: over a travel of s, a point at
// distance y from its path is dark for 2 sqrt(r^2 - y^2) / s of the time. A pass is uncertain where an edge is within the
// pixel, of width w: 2 w / s of the passes, with a variance of 1/6 on average. All pixels within five deviations; a row's
// mean within five of its own.
void expect_exposure_of_disc(const Scene& scene, double radius, double travel)
{
    const Image image = render(scene, {"path", passes, {}}, 3);
    constexpr double width = 2.0 / size;
    const double deviation = std::sqrt(2 * width / travel / 6 / passes);
    for (int y = 0; y < size; y++) {
        double dark = 0.0;
        constexpr int points = 200;
        for (int i = 0; i < points; i++) {
            const double distance = -1 + width * (y + (i + 0.5) / points);
            dark += 2 * std::sqrt(std::max(0.0, radius * radius - distance * distance)) / travel / points;
        }
        for (int x = 0; x < size; x++) EXPECT_NEAR(image.at(x, y, 1), 1 - dark, 5 * deviation + 1e-5) << x << ", " << y;
        EXPECT_NEAR(window_mean(image, 0, y, size, y + 1), 1 - dark, 5 * deviation / std::sqrt(size) + 1e-5) << "row " << y;
    }
}

Scene white_with_disc()
{
    Scene scene = scene_from_above(size);
    scene.sensor.shutter = {2, 4};
    scene.emitters.push_back({{}, ConstantEmitter{{1, 1, 1}}});
    add_bsdf(scene, DiffuseBsdf{{0, 0, 0}});
    return scene;
}

ShapeDescription disc(Vec3 center, float radius)
{
    ShapeDescription shape;
    shape.geometry = Disk{center, {radius, 0, 0}, {0, 0, -radius}};
    return shape;
}

TEST(Motion, ExposureOfACrossingDisc)
{
    Scene scene = white_with_disc();
    // Also outside of the shutter's time, which must not show.
    add_moving(scene, disc({0, 0, 0}, 0.6f), slide({-4, 0, 0}, {4, 0, 0}, 1, 5));
    expect_exposure_of_disc(scene, 0.6, 4.0);
}

TEST(Motion, ExposureUnderACrossingCamera)
{
    Scene scene = white_with_disc();
    scene.shapes.push_back(disc({0, 0, 0}, 0.6f));
    move_camera(scene, {{2, Transform::translate({-2, 0, 0})}, {4, Transform::translate({2, 0, 0})}});
    expect_exposure_of_disc(scene, 0.6, 4.0);
}

// A mirror at 45 degrees, y = x + c, turns rays from above to a wall that shines above y = 0. As c goes from -3/2 to
// 3/2, the point x sees it for (x + 3/2) / 3 of the time. A pass is uncertain for w / 3 of the passes.
TEST(Motion, ExposureInAMovingMirror)
{
    Scene scene = scene_from_above(size);
    scene.sensor.shutter = {0, 1};
    const uint mirror = add_bsdf(scene, ConductorBsdf{});
    add_moving(scene, make_quad({-4, -4, -4}, {-4, -4, 4}, {4, 4, 4}, {4, 4, -4}, mirror), slide({0, -1.5, 0}, {0, 1.5, 0}));
    ShapeDescription wall = make_quad({-9, 0, 9}, {-9, 0, -9}, {-9, 9, -9}, {-9, 9, 9}, mirror);
    wall.emitter = AreaEmitter{{1, 1, 1}};
    scene.shapes.push_back(wall);
    scene.sensor.position.y = 8;
    for (const char* method : {"path", "sppm"}) {
        SCOPED_TRACE(method);
        const Image image = render(scene, {method, passes, {}}, 3);
        constexpr double width = 2.0 / size;
        const double deviation = std::sqrt(width / 3 / 6 / passes);
        for (int x = 0; x < size; x++) {
            const double expected = (-1 + width * (x + 0.5) + 1.5) / 3;
            for (int y = 0; y < size; y++) EXPECT_NEAR(image.at(x, y, 1), expected, 5 * deviation + 1e-5) << x << ", " << y;
            EXPECT_NEAR(window_mean(image, x, 0, x + 1, size), expected, 5 * deviation / std::sqrt(size) + 1.0 / passes) << "column " << x;
        }
    }
}

// A glass ball and a tumbling block in a box, seen by a camera that moves and turns. The box alone decides the bounds.
Scene moving_box()
{
    Scene scene = cornell_box(size);
    scene.sensor.shutter = {0.25, 0.75};
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    add_moving(scene, make_sphere({0, 0, 0}, 0.35f, glass), slide({-.5, -.6, .3}, {.5, -.4, .3}));
    add_moving(scene, make_quad({-.3f, -.3f, 0}, {.3f, -.3f, 0}, {.3f, .3f, 0}, {-.3f, .3f, 0}, 1),
               AnimatedTransform(Keys{{0, Transform::translate({.4, .2, -.4})},
                                      {1, Transform::translate({-.4, .3, -.4}) * Transform::rotate({1, 2, 0}, 150)}}));
    move_camera(scene, {{0, Transform::translate({-.1, 0, 0})}, {1, Transform::translate({.2, .1, 0}) * Transform::rotate({0, 1, 0}, 5)}});
    return scene;
}

// The same scene as a still of one time, placed by instances as well.
Scene still(Scene scene, double time)
{
    for (auto& instance : scene.instances) instance.to_world = instance.to_world.at(time);
    scene.sensor = sensor_at(scene.sensor, time);
    scene.sensor.motion.reset();
    scene.sensor.shutter = {};
    return scene;
}

RenderRequest small_request(const std::string& method, std::uint64_t iterations)
{
    RenderRequest request{method, iterations, {{"max_depth", "6"}}};
    if (method == "pppm" || method == "sppm") request.parameters["radius"] = "0.05"; // else it depends on the first camera
    return request;
}

// Photons and camera of a pass see the scene as it is at the pass's time: bit for bit.
TEST(Motion, APassIsAStillForEveryMethod)
{
    const Scene scene = moving_box();
    for (const MethodInfo* method : all_methods()) {
        if (method->name != "path" && method->name != "ptracer" && method->name != "pppm" && method->name != "sppm") continue;
        for (std::uint64_t seed : {1u, 2u, 9u}) {
            const double time = pass_time(scene.sensor.shutter, seed, 0);
            const Image moving = render(scene, small_request(method->name, 1), seed);
            EXPECT_TRUE(moving.pixels == render(still(scene, time), small_request(method->name, 1), seed).pixels)
                << method->name << ", seed " << seed;
            EXPECT_FALSE(moving.pixels == render(still(scene, time + 0.01), small_request(method->name, 1), seed).pixels) << method->name;
        }
    }
}

// Pass i of a still is i + 1 times its mean over i + 1 passes, less i times that over i: true of all channels but the
// variances, 3 to 5.
TEST(Motion, TheMeanOverPassesIsThatOfStills)
{
    const Scene scene = moving_box();
    constexpr std::uint64_t count = 5, seed = 4;
    for (const char* method : {"path", "ptracer", "pppm"}) {
        SCOPED_TRACE(method);
        const Image moving = render(scene, small_request(method, count), seed);
        std::vector<double> mean(moving.pixels.size());
        for (std::uint64_t i = 0; i < count; i++) {
            const Scene frozen = still(scene, pass_time(scene.sensor.shutter, seed, i));
            const Image with = render(frozen, small_request(method, i + 1), seed),
                        without = render(frozen, small_request(method, std::max<std::uint64_t>(i, 1)), seed);
            for (std::size_t k = 0; k < mean.size(); k++)
                mean[k] += (static_cast<double>(i + 1) * with.pixels[k] - static_cast<double>(i) * without.pixels[k]) / count;
        }
        std::size_t different = 0;
        for (std::size_t k = 0; k < mean.size(); k++)
            if (const std::size_t channel = k % moving.channels.size(); channel < 3 || channel > 5)
                different += std::abs(mean[k] - moving.pixels[k]) > 2e-6 * (1 + std::abs(mean[k]));
        EXPECT_EQ(different, 0u);
    }
}

TEST(Motion, ResumedIsUninterrupted)
{
    const std::filesystem::path file = std::filesystem::temp_directory_path() / ("sundog-motion-" + std::to_string(::getpid()));
    const Scene scene = moving_box();
    for (const char* method : {"path", "ptracer", "pppm", "sppm"}) {
        RenderSettings settings;
        settings.method = method;
        settings.seed = 5;
        RenderSession whole(scene, shared_device(), settings), first(scene, shared_device(), settings),
            second(scene, shared_device(), settings);
        for (int i = 0; i < 5; i++) whole.iterate();
        for (int i = 0; i < 2; i++) first.iterate();
        first.save_checkpoint(file);
        second.resume(file);
        for (int i = 0; i < 3; i++) second.iterate();
        EXPECT_TRUE(second.image().pixels == whole.image().pixels) << method;
        // Not that of another motion.
        Scene other = scene;
        other.sensor.shutter.close = 0.8;
        RenderSession third(other, shared_device(), settings);
        EXPECT_THROW(third.resume(file), FileError) << method;
    }
    std::filesystem::remove(file);
}

TEST(Motion, MethodsWhosePathsOutliveAPassRefuseIt)
{
    Scene scene = cornell_box(8);
    move_camera(scene, {{0.0, Transform()}, {1.0, Transform::translate({0.1, 0, 0})}});
    scene.sensor.shutter = {0, 1};
    for (const RenderRequest& request :
         {RenderRequest{"ppm", 1, {}}, RenderRequest{"pssmlt", 1, {}}, RenderRequest{"psr", 1, {{"paths", "pssmlt"}}}}) {
        try {
            render(scene, request, 1);
            FAIL() << request.method << " rendered";
        } catch (const SceneError& error) {
            EXPECT_NE(std::string(error.what()).find(request.method), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("-m sppm"), std::string::npos) << error.what();
        }
    }
    EXPECT_NO_THROW(render(scene, {"psr", 1, {}}, 1));
}

} // namespace
} // namespace sundog::test
