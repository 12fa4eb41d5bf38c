// Where light paths start: the flux of every kind of light, and the distribution of positions and directions.
#include "stages/device_scene.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"
#include "support/direction_grid.h"
#include "support/environment_probe.h"
#include "support/scene_builder.h"

namespace sundog
{
namespace
{

using std::numbers::pi;

constexpr int tests_in_file = 22;
constexpr uint samples = 100'000;

struct Emission {
    std::vector<Ray> rays;
    std::vector<Vec3> flux;
};

class LightEmission : public DeviceFixture
{
protected:
    Emission emit(const Scene& scene)
    {
        const DeviceScene device_scene(device_, scene);
        const auto rays = allocate<Ray>(samples);
        const auto flux = allocate<Vec3>(samples);
        kernel_(samples, device_scene.surfaces(), samples, rays, flux);
        return {rays.download(), flux.download()};
    }

    // The mean of the flux is the power; its red channel is asked for.
    static void expect_power(const Emission& emission, double power)
    {
        double sum = 0.0, squares = 0.0;
        for (const Vec3& flux : emission.flux) {
            sum += flux.x;
            squares += static_cast<double>(flux.x) * flux.x;
        }
        const double mean = sum / samples, deviation = std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples);
        EXPECT_NEAR(mean, power, 4.5 * deviation + 1e-5 * power);
    }

    // Directions about the normal at their origins, with density cos / pi.
    static void expect_cosine_lobe(const Emission& emission, const std::function<Vec3d(Vec3d)>& normal_at)
    {
        std::vector<double> counts(10 * 16, 0.0);
        for (const Ray& ray : emission.rays) {
            const Frame3d frame(normal_at(ray.origin));
            const Vec3d d = frame.to_local(ray.direction);
            ASSERT_GE(d.z, -1e-5);
            ASSERT_NEAR(length(d), 1.0, 1e-5);
            const double sin2 = std::min(d.x * d.x + d.y * d.y, 0.999999); // uniform in [0, 1]
            counts.at(static_cast<std::size_t>(sin2 * 10) * 16 +
                      static_cast<std::size_t>((std::atan2(d.y, d.x) / (2 * pi) + 0.5) * 15.9999)) += 1.0;
        }
        EXPECT_TRUE(is_uniform(counts, tests_in_file)) << "directions";
    }

private:
    Kernel kernel_ = test_kernel(R"(
        #include "scene/emission.h"
        __kernel void test(SURFACE_PARAMETERS, uint count, __global Ray* rays, __global Vec3* flux)
        {
            uint i = get_global_id(0);
            if (i >= count) return;
            const SurfaceView scene = SURFACE_VIEW;
            const EmissionSample sample = sample_emission(&scene, random_words(i, 21u), random4(i, 22u).xy);
            rays[i] = sample.ray;
            flux[i] = pack(sample.flux);
        })");
};

TEST_F(LightEmission, MeshEmitsUniformlyFromItsArea)
{
    // 2 x 1 in the plane z = 1, facing down, of two triangles.
    const Emission emission = emit(SceneBuilder().light(parallelogram({0, 0, 1}, {0, 1, 0}, {2, 0, 0}), {3, 0, 0}).scene);
    expect_power(emission, pi * 2.0 * 3.0);
    std::vector<double> counts(20 * 10, 0.0);
    for (const Ray& ray : emission.rays) {
        ASSERT_NEAR(ray.origin.z, 1.0f, 1e-4f);
        ASSERT_LT(ray.origin.z, 1.0f) << "not in front of the light";
        counts.at(static_cast<std::size_t>(std::min(ray.origin.x * 10.0f, 19.9f)) * 10 +
                  static_cast<std::size_t>(std::min(ray.origin.y * 10.0f, 9.9f))) += 1.0;
    }
    EXPECT_TRUE(is_uniform(counts, tests_in_file));
    expect_cosine_lobe(emission, [](Vec3d) { return Vec3d(0, 0, -1); });
}

TEST_F(LightEmission, SphereEmitsOutwardsOrInwards)
{
    const Vec3d center(1, 2, 3);
    for (const bool flipped : {false, true}) {
        const Emission emission = emit(SceneBuilder().light(Sphere{to_float(center), 0.5f, flipped}, {3, 0, 0}).scene);
        expect_power(emission, 4.0 * pi * 0.25 * pi * 3.0);
        const DirectionGrid grid{.rows = 12, .columns = 20};
        std::vector<Vec3d> outwards;
        for (const Ray& ray : emission.rays) outwards.push_back(normalized(Vec3d(ray.origin) - center));
        EXPECT_TRUE(follows(grid.count(outwards), grid.expected([](Vec3d) { return 0.25 / pi; }, samples, 1), tests_in_file));
        expect_cosine_lobe(emission, [&](Vec3d origin) { return flipped ? center - origin : origin - center; });
    }
}

TEST_F(LightEmission, CylinderEmitsOutwardsOrInwards)
{
    for (const bool flipped : {false, true}) {
        const Cylinder cylinder{.start = {1, 2, 3}, .radius = 0.5f, .length = 2.0f, .flip_normals = flipped, .axis_x = {0, 1, 0}, .axis_y = {0, 0, 1}, .axis_z = {1, 0, 0}};
        const Emission emission = emit(SceneBuilder().light(cylinder, {3, 0, 0}).scene);
        expect_power(emission, 2.0 * pi * 0.5 * 2.0 * pi * 3.0);
        const auto outwards = [](Vec3d origin) { return Vec3d(0, origin.y - 2.0, origin.z - 3.0); };
        std::vector<double> counts(10 * 16, 0.0);
        for (const Ray& ray : emission.rays) {
            const Vec3d n = outwards(ray.origin);
            ASSERT_NEAR(length(n), 0.5, 1e-4);
            counts.at(static_cast<std::size_t>(std::clamp((ray.origin.x - 1.0) / 2.0, 0.0, 0.999999) * 10) * 16 +
                      static_cast<std::size_t>((std::atan2(n.z, n.y) / (2 * pi) + 0.5) * 15.9999)) += 1.0;
        }
        EXPECT_TRUE(is_uniform(counts, tests_in_file));
        expect_cosine_lobe(emission, [&](Vec3d origin) { return flipped ? -outwards(origin) : outwards(origin); });
    }
}

TEST_F(LightEmission, EllipseEmitsUniformly)
{
    const Emission emission = emit(SceneBuilder().light(Disk{{0, 0, 0}, {2, 0, 0}, {0, 0.5f, 0}}, {3, 0, 0}).scene);
    expect_power(emission, pi * 2.0 * 0.5 * pi * 3.0);
    std::vector<double> counts(10 * 16, 0.0);
    for (const Ray& ray : emission.rays) {
        const double a = ray.origin.x / 2.0, b = ray.origin.y / 0.5;
        const double r2 = std::min(a * a + b * b, 0.999999);
        counts.at(static_cast<std::size_t>(r2 * 10) * 16 + static_cast<std::size_t>((std::atan2(b, a) / (2 * pi) + 0.5) * 15.9999)) += 1.0;
    }
    EXPECT_TRUE(is_uniform(counts, tests_in_file));
    expect_cosine_lobe(emission, [](Vec3d) { return Vec3d(0, 0, 1); });
}

TEST_F(LightEmission, PointAndSpot)
{
    const Emission point = emit(SceneBuilder().emitter(PointEmitter{{1, 1, 1}, {2, 0, 0}}).shape(Sphere{{0, 0, 0}, 0.1f}).scene);
    expect_power(point, 4.0 * pi * 2.0);
    const DirectionGrid sphere{.rows = 12, .columns = 20};
    std::vector<Vec3> directions;
    for (const Ray& ray : point.rays) {
        ASSERT_EQ(ray.origin.x, 1.0f);
        directions.push_back(ray.direction);
    }
    EXPECT_TRUE(follows(sphere.count(directions), sphere.expected([](Vec3d) { return 0.25 / pi; }, samples, 1), tests_in_file));

    const double cutoff = 0.8, beam = 0.3;
    const Vec3d axis = normalized({0.2, -0.4, -0.9});
    const SpotEmitter spot{{1, 1, 1}, to_float(axis), {2, 0, 0}, static_cast<float>(cutoff), static_cast<float>(beam)};
    const Emission emission = emit(SceneBuilder().emitter(spot).shape(Sphere{{0, 0, 0}, 0.1f}).scene);
    double power = 0.0;
    constexpr int steps = 100'000;
    for (int i = 0; i < steps; ++i) {
        const double angle = (i + 0.5) / steps * cutoff;
        power += 2.0 * (angle <= beam ? 1.0 : (cutoff - angle) / (cutoff - beam)) * 2.0 * pi * std::sin(angle) * cutoff / steps;
    }
    expect_power(emission, power);
    // Flux by angle: the intensity of each sample over the uniform density.
    for (std::size_t i = 0; i < samples; ++i) {
        const double angle = std::acos(std::min(1.0, dot(Vec3d(emission.rays[i].direction), axis)));
        ASSERT_LE(angle, cutoff + 1e-3);
        const double falloff = std::clamp((cutoff - angle) / (cutoff - beam), 0.0, 1.0);
        ASSERT_NEAR(emission.flux[i].x, 2.0 * falloff * 2.0 * pi * (1.0 - std::cos(cutoff)), 5e-3);
    }
}

// Rays of distant lights start outside of the scene, on a disk as wide as it, across their direction.
TEST_F(LightEmission, DistantLightsCoverTheScene)
{
    const Vec3d center(4, 5, 6);
    const double radius = std::sqrt(3.0) * 2.0 * 1.001; // of the sphere about the bounding box
    const Vec3d down = normalized({0.1, 0.3, -0.8});
    const Sphere scene_sphere{to_float(center), 2.0f, false};
    const Emission directional = emit(SceneBuilder().emitter(DirectionalEmitter{to_float(down), {2, 0, 0}}).shape(scene_sphere).scene);
    expect_power(directional, 2.0 * pi * radius * radius);
    const Emission constant = emit(SceneBuilder().emitter(ConstantEmitter{{2, 0, 0}}).shape(scene_sphere).scene);
    expect_power(constant, 2.0 * pi * 4.0 * pi * radius * radius);

    for (const Emission* emission : {&directional, &constant}) {
        std::vector<double> counts(10 * 16, 0.0);
        std::vector<Vec3> directions;
        for (const Ray& ray : emission->rays) {
            const Frame3d frame(ray.direction);
            const Vec3d d = frame.to_local(Vec3d(ray.origin) - center) / radius;
            ASSERT_NEAR(d.z, -1.0, 1e-5);
            const double r2 = std::min(d.x * d.x + d.y * d.y, 0.999999);
            counts.at(static_cast<std::size_t>(r2 * 10) * 16 +
                      static_cast<std::size_t>((std::atan2(d.y, d.x) / (2 * pi) + 0.5) * 15.9999)) += 1.0;
            directions.push_back(ray.direction);
        }
        EXPECT_TRUE(is_uniform(counts, tests_in_file)) << "origins";
        if (emission == &directional) {
            for (const Vec3& d : directions) ASSERT_NEAR(length(Vec3d(d) - down), 0.0, 1e-6);
        } else {
            const DirectionGrid grid{.rows = 12, .columns = 20};
            EXPECT_TRUE(follows(grid.count(directions), grid.expected([](Vec3d) { return 0.25 / pi; }, samples, 1), tests_in_file));
        }
    }
}

// Directions with the density of the map, and a flux that is radiance over that density.
TEST_F(LightEmission, EnvironmentMap)
{
    for (const auto& [width, height] : {std::pair{8, 5}, std::pair{64, 33}, std::pair{6, 1}}) {
        for (const float sun : {1.0f, 3000.0f}) {
            const EnvironmentEmitter map = turned_environment(random_environment(width, height, sun), 0.5f);
            const PlainEnvironment plain(map);
            const Emission emission = emit(SceneBuilder().emitter(map).shape(Sphere{{4, 5, 6}, 2.0f, false}).scene);
            const double disk = pi * 12.0 * 1.001 * 1.001;
            expect_power(emission, disk * plain.integrate([](Vec3d, double radiance) { return radiance; }));
            std::vector<Vec3d> directions;
            int misplaced = 0;
            for (std::size_t i = 0; i < samples; ++i) {
                const Vec3d d = normalized(-Vec3d(emission.rays[i].direction));
                directions.push_back(d);
                const double flux = disk * plain.radiance(d) / plain.density(d);
                misplaced += std::abs(emission.flux[i].x - flux) > 2e-3 * flux;
            }
            EXPECT_LT(misplaced, static_cast<int>(samples) / 100); // beside a patch's border, or next to black
            if (sun > 1.0f) continue; // a bin's border through the sun would need a finer quadrature
            const DirectionGrid grid{.rows = 12, .columns = 20};
            EXPECT_TRUE(follows(grid.count(directions), grid.expected([&](Vec3d d) { return plain.density(d); }, samples, 24), tests_in_file, 5e-3));
        }
    }
}

// Uniform over the image that it throws on a plane one unit away.
TEST_F(LightEmission, Projector)
{
    const ProjectorEmitter projector{.position = {1, 1, 1}, .half_width = 0.8f, .half_height = 0.5f, .irradiance = {3, 0, 0}, .texture = {}};
    const Emission emission = emit(SceneBuilder().emitter(projector).shape(Sphere{{0, 0, 0}, 0.1f}).scene);
    expect_power(emission, 3.0 * 4.0 * 0.8 * 0.5);
    std::vector<double> counts(16 * 10, 0.0);
    for (const Ray& ray : emission.rays) {
        const double x = 0.5 + 0.5 * ray.direction.x / ray.direction.z / 0.8, y = 0.5 + 0.5 * ray.direction.y / ray.direction.z / 0.5;
        ASSERT_TRUE(x > -1e-5 && x < 1.00001 && y > -1e-5 && y < 1.00001);
        counts.at(static_cast<std::size_t>(std::clamp(x, 0.0, 0.99999) * 16) * 10 + static_cast<std::size_t>(std::clamp(y, 0.0, 0.99999) * 10)) += 1.0;
    }
    EXPECT_TRUE(is_uniform(counts, tests_in_file));
}

TEST_F(LightEmission, CollimatedIsOneRay)
{
    const CollimatedEmitter beam{{1, 2, 3}, {0, 0.6f, -0.8f}, {3, 0, 0}};
    const Emission emission = emit(SceneBuilder().emitter(beam).shape(Sphere{{0, 0, 0}, 0.1f}).scene);
    for (std::size_t i = 0; i < samples; i++) {
        ASSERT_EQ(emission.rays[i].origin, beam.position);
        ASSERT_EQ(emission.rays[i].direction, beam.direction);
        ASSERT_EQ(emission.flux[i], beam.power);
    }
}

// Several lights together: the mean is the sum of powers, channel by channel.
TEST_F(LightEmission, SumsOverLights)
{
    const Emission emission = emit(SceneBuilder()
                                       .light(Sphere{{0, 0, 0}, 1.0f, false}, {1, 0, 0})
                                       .light(parallelogram({3, 0, 0}, {1, 0, 0}, {0, 1, 0}), {5, 1, 0})
                                       .emitter(PointEmitter{{0, 5, 0}, {0.5f, 0, 2}})
                                       .scene);
    expect_power(emission, 4.0 * pi * pi + 5.0 * pi + 4.0 * pi * 0.5);
    double blue = 0.0;
    for (const Vec3& flux : emission.flux) blue += flux.z / samples;
    EXPECT_NEAR(blue, 4.0 * pi * 2.0, 0.05 * 4.0 * pi * 2.0);
}

} // namespace
} // namespace sundog
