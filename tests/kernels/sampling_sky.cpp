// Sky and sun on the device: what is seen is the model, directions follow their density, and the irradiance is right.
#include "scene/clear_sky.h"
#include "scene/flatten_environment.h"
#include "stages/device_scene.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"
#include "support/direction_grid.h"
#include "support/scene_builder.h"

#include <cmath>
#include <numbers>

namespace sundog
{
namespace
{

using std::numbers::pi;

constexpr int tests_in_file = 2;
constexpr uint samples = 100'000;

struct Seen {
    std::vector<Vec3> directions, radiance;
    std::vector<float> pdfs;
};

class Sky : public DeviceFixture
{
protected:
    static Scene scene_under(const SunSkyEmitter& emitter) { return SceneBuilder().emitter(emitter).shape(Sphere{{0, 0, 0}, 0.01f}).scene; }

    // In the given directions or, without any, in drawn ones.
    Seen see(const SunSkyEmitter& emitter, const std::vector<Vec3d>& given = {})
    {
        const DeviceScene scene(device_, scene_under(emitter));
        const Kernel kernel = test_kernel(R"(
            #include "scene/lights.h"
            __kernel void test(SURFACE_PARAMETERS, uint drawn, uint count, __global Vec3* directions, __global Vec3* radiance, __global float* pdfs)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const SurfaceView scene = SURFACE_VIEW;
                const EnvironmentMap map = scene.environment_maps[0];
                float3 direction = unpack(directions[i]);
                const float4 u = random4(i, 5u);
                EnvironmentValue value;
                if (drawn) value = sample_environment_map(&scene, &map, u.xy, u.z, &direction);
                else value = environment_value(&scene, direction);
                directions[i] = pack(direction);
                radiance[i] = pack(value.radiance);
                pdfs[i] = value.pdf_w;
            })");
        std::vector<Vec3> places;
        for (const Vec3d& d : given) places.push_back(to_float(d));
        if (given.empty()) places.resize(samples);
        const uint count = static_cast<uint>(places.size());
        const auto directions = upload(places);
        const auto radiance = allocate<Vec3>(count);
        const auto pdfs = allocate<float>(count);
        kernel(count, scene.surfaces(), uint(given.empty()), count, directions, radiance, pdfs);
        return {directions.download(), radiance.download(), pdfs.download()};
    }
};

SunSkyEmitter afternoon()
{
    SunSkyEmitter emitter;
    emitter.up = to_float(normalized(Vec3d(0.2, 0.9, -0.3)));
    emitter.sun_direction = to_float(normalized(Vec3d(0.6, 0.5, 0.4)));
    emitter.turbidity = 4.0f;
    emitter.albedo = {0.2f, 0.3f, 0.4f};
    return emitter;
}

TEST_F(Sky, IsSeenAsTheModelHasIt)
{
    const SunSkyEmitter emitter = afternoon();
    const Vec3d up(emitter.up), sun(emitter.sun_direction);
    const ClearSky model(emitter.turbidity, emitter.albedo, std::asin(dot(up, sun)));
    const std::vector<Vec3d> directions = DirectionGrid{.rows = 60, .columns = 60}.midpoints(1);
    const Seen seen = see(emitter, directions);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double cosine = dot(directions[i], up);
        if (std::abs(cosine) < 1e-5) continue; // rounding decides
        if (cosine < 0.0) {
            ASSERT_EQ(seen.radiance[i], (Vec3{0, 0, 0}));
            ASSERT_EQ(seen.pdfs[i], 0.0f);
            continue;
        }
        const double cos_gamma = std::min(dot(directions[i], sun), 1.0);
        if (cos_gamma > std::cos(0.01)) continue; // the sun
        const Vec3 expected = model.sky(cosine, std::acos(cos_gamma));
        // Linear between rows of texels, while the model goes with the root of the height: in the last row it is off by a quarter of
        // what the root adds there.
        const float tolerance = cosine < 0.0041 ? 0.06f : cosine < 0.02 ? 0.03f : 2e-3f;
        ASSERT_NEAR(seen.radiance[i].x, expected.x, tolerance * expected.x) << cosine << ", " << cos_gamma;
        ASSERT_NEAR(seen.radiance[i].y, expected.y, tolerance * expected.y) << cosine << ", " << cos_gamma;
        ASSERT_NEAR(seen.radiance[i].z, expected.z, tolerance * expected.z) << cosine << ", " << cos_gamma;
    }
}

// All around the middle of the disk, from there to beyond its rim.
TEST_F(Sky, SunHasItsRadiusAndRadiance)
{
    for (const float aperture : {0.5358f, 20.0f}) {
        SunSkyEmitter emitter = afternoon();
        emitter.sky_scale = 0.0f;
        emitter.sun_aperture = aperture;
        const Vec3d up(emitter.up), sun(emitter.sun_direction);
        const Frame3d frame(sun);
        const double rim = std::sin(0.5 * static_cast<double>(aperture) * pi / 180.0);
        const double spread = std::pow(std::sin(0.5 * sun_half_angle) / std::sin(0.25 * static_cast<double>(aperture) * pi / 180.0), 2.0);
        const ClearSky model(emitter.turbidity, emitter.albedo, std::asin(dot(up, sun)));
        std::vector<Vec3d> directions;
        std::vector<double> radii;
        for (const double radius : {0.0, 0.3, 0.7, 0.9, 0.999, 1.001, 1.2})
            for (int turn = 0; turn < 8; ++turn) {
                radii.push_back(radius);
                const double sine = radius * rim, phi = turn;
                directions.push_back(frame.to_world({sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1.0 - sine * sine)}));
            }
        const Seen seen = see(emitter, directions);
        for (std::size_t i = 0; i < directions.size(); ++i) {
            if (radii[i] > 1.0) {
                EXPECT_EQ(seen.radiance[i].x, 0.0f) << radii[i];
                EXPECT_EQ(seen.pdfs[i], 0.0f);
                continue;
            }
            const Vec3 expected = model.sun(std::asin(dot(directions[i], up)), std::sqrt(1.0 - radii[i] * radii[i])) * static_cast<float>(spread);
            // Linear between texels, while the darkening has an infinite slope at the rim.
            const float tolerance = radii[i] > 0.99 ? 0.2f : 0.01f;
            EXPECT_NEAR(seen.radiance[i].x, expected.x, tolerance * expected.x) << radii[i];
            EXPECT_NEAR(seen.radiance[i].z, expected.z, tolerance * expected.z) << radii[i];
            EXPECT_NEAR(seen.pdfs[i], 1.0 / (4.0 * pi * std::pow(std::sin(0.25 * static_cast<double>(aperture) * pi / 180.0), 2.0)), 1e-3 * seen.pdfs[i]);
        }
    }
}

// Half of the choices are the sun's and the sky's in equal parts; the sun is so wide that bins see its shape.
TEST_F(Sky, DirectionsFollowTheirDensity)
{
    for (const bool stretched : {false, true}) {
        SunSkyEmitter emitter = afternoon();
        emitter.sun_aperture = 60.0f;
        if (stretched) {
            emitter.stretch = 1.3f;
            emitter.sun_direction = emitter.up;
        }
        const DirectionGrid grid{.rows = 24, .columns = 20};
        const Seen there = see(emitter, grid.midpoints(24));
        EXPECT_TRUE(follows(grid.count(see(emitter).directions), grid.expected(there.pdfs, 24, samples), tests_in_file, 5e-3)) << stretched;
    }
}

// Radiance over density, in the mean, is the sum over the model: of the sky by the midpoint rule, of the sun its power.
TEST_F(Sky, IrradianceIsThatOfTheModel)
{
    const SunSkyEmitter emitter = afternoon();
    const Vec3d up(emitter.up), sun(emitter.sun_direction);
    const ClearSky model(emitter.turbidity, emitter.albedo, std::asin(dot(up, sun)));
    const Frame3d frame(up);
    double expected = 0.0;
    constexpr int steps = 400;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double cosine = (i + 0.5) / steps, sine = std::sqrt(1.0 - cosine * cosine), phi = 2.0 * pi * (j + 0.5) / steps;
            const Vec3d d = frame.to_world({sine * std::cos(phi), sine * std::sin(phi), cosine});
            expected += model.sky(cosine, std::acos(std::min(dot(d, sun), 1.0))).y * cosine * 2.0 * pi / (steps * steps);
        }
    double disk = 0.0; // int 2 r L(r) dr over the disk
    for (int i = 0; i < steps; ++i) {
        const double r = (i + 0.5) / steps;
        disk += 2.0 * r * model.sun(std::asin(dot(up, sun)), std::sqrt(1.0 - r * r)).y / steps;
    }
    expected += disk * pi * std::pow(std::sin(sun_half_angle), 2.0) * dot(up, sun);

    const Seen drawn = see(emitter);
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < samples; ++i) {
        const double e = drawn.pdfs[i] > 0.0f ? drawn.radiance[i].y * std::max(dot(Vec3d(drawn.directions[i]), up), 0.0) / drawn.pdfs[i] : 0.0;
        sum += e / samples;
        squares += e * e / samples;
    }
    const double error = std::sqrt((squares - sum * sum) / samples);
    EXPECT_LT(error, 0.01 * expected);
    EXPECT_NEAR(sum, expected, 4.5 * error + 2e-3 * expected);
}

} // namespace
} // namespace sundog
