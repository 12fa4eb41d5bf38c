// Choosing lights and sampling them from a surface: frequencies against powers, directions against the density that
// BSDF sampling would compute for them (what multiple importance sampling rests on), and irradiance against its
// analytic value. Every shadow ray must reach its light.
#include "scene/light_list.h"
#include "stages/device_scene.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"
#include "support/direction_grid.h"
#include "support/environment_probe.h"
#include "support/scene_builder.h"

#include <algorithm>
#include <numeric>

namespace sundog
{
namespace
{

using std::numbers::pi;

constexpr int tests_in_file = 18;
constexpr uint samples = 100'000;

struct LightSamples {
    std::vector<Vec3> directions; // zero: no light that way
    std::vector<float> pdfs;      // 0 for point-like lights
    std::vector<Vec3> radiance;   // over pdf
    std::vector<uint> occluded;
};

class Lights : public DeviceFixture
{
protected:
    LightSamples sample(const DeviceScene& scene, Vec3 position, Vec3 normal)
    {
        const Kernel kernel = test_kernel(R"(
            #include "scene/lights.h"
            __kernel void test(SURFACE_PARAMETERS, Vec3 position, Vec3 normal, uint count, __global Vec3* directions, __global float* pdfs,
                               __global Vec3* radiance, __global Ray* shadow_rays)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const SurfaceView scene = SURFACE_VIEW;
                Surface surface;
                surface.position = unpack(position);
                surface.geometric_normal = surface.shading_normal = surface.outgoing = unpack(normal);
                surface.offset = OFFSET_PER_COORDINATE * max_abs(surface.position);
                surface.shape = surface.primitive = 0u;
                LightSample sample;
                const bool lit = sample_light(&scene, &surface, 0u, random_words(i, 11u), &sample);
                directions[i] = pack(lit ? sample.direction : (float3)(0.0f));
                pdfs[i] = lit ? sample.pdf_w : 0.0f;
                radiance[i] = pack(lit ? sample.radiance : (float3)(0.0f));
                shadow_rays[i] = lit ? sample.shadow_ray : no_ray();
            })");
        const auto directions = allocate<Vec3>(samples), radiance = allocate<Vec3>(samples);
        const auto pdfs = allocate<float>(samples);
        const auto rays = allocate<Ray>(samples);
        kernel(samples, scene.surfaces(), position, normal, samples, directions, pdfs, radiance, rays);

        std::vector<uint> active(samples);
        std::iota(active.begin(), active.end(), 0u);
        const auto occluded = allocate<uint>(samples);
        Kernel(device_, "trace_any", "Trace", scene.trace_options())(samples, scene.geometry(), rays, upload(active),
                                                                     upload(std::vector{samples}), occluded);
        return {directions.download(), pdfs.download(), radiance.download(), occluded.download()};
    }

    // The density of sampling light 0 from `position` in each direction, 0 where another surface or its back is hit.
    std::vector<float> densities(const DeviceScene& scene, Vec3 position, const std::vector<Vec3d>& directions)
    {
        const uint count = static_cast<uint>(directions.size());
        std::vector<Ray> rays;
        std::vector<uint> active(count);
        std::iota(active.begin(), active.end(), 0u);
        for (const Vec3d& d : directions) rays.push_back({position, INFINITY, to_float(d), 0});
        const auto device_rays = upload(rays);
        const auto hits = allocate<Hit>(count);
        Kernel(device_, "trace_closest", "Trace", scene.trace_options())(count, scene.geometry(), device_rays, hits, upload(active),
                                                                         upload(std::vector{count}));
        const Kernel kernel = test_kernel(R"(
            #include "scene/lights.h"
            __kernel void test(SURFACE_PARAMETERS, uint count, __global const Ray* rays, __global const Hit* hits, __global float* pdfs)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                pdfs[i] = 0.0f;
                const SurfaceView scene = SURFACE_VIEW;
                if (hits[i].primitive == NO_PRIMITIVE) {
                    if (globals->environment_light == 0u) pdfs[i] = environment_value(&scene, unpack(rays[i].direction)).pdf_w;
                    return;
                }
                const Surface surface = surface_at(&scene, rays[i], hits[i]);
                const uint light = light_of_hit(&scene, &surface);
                if (is_black(emitted_radiance(&scene, &surface, light)) || light != 0u) return;
                pdfs[i] = light_pdf_w(&scene, &surface, light, rays[i]);
            })");
        const auto pdfs = allocate<float>(count);
        kernel(count, scene.surfaces(), count, device_rays, hits, pdfs);
        return pdfs.download();
    }

    // Light 0 of the scene has a density (1/sr); others may be point-like. cap: 1 - cos of a cone about `towards`
    // that holds light 0. irradiance: of all lights at the point (W/m^2).
    struct Case {
        const char* name;
        Scene scene;
        Vec3 position, normal;
        Vec3d towards;
        double cap;
        double irradiance;
    };

    void check(const Case& c)
    {
        SCOPED_TRACE(c.name);
        const DeviceScene scene(device_, c.scene);
        const LightSamples drawn = sample(scene, c.position, c.normal);
        check_directions(c, scene, drawn);
        check_irradiance(c, drawn);
    }

    static void check_irradiance(const Case& c, const LightSamples& drawn)
    {
        double sum = 0.0, squares = 0.0;
        uint blocked = 0;
        for (std::size_t i = 0; i < samples; ++i) {
            const double e = drawn.radiance[i].x * std::max(0.0, dot(Vec3d(drawn.directions[i]), Vec3d(c.normal)));
            sum += e;
            squares += e * e;
            if (length(Vec3d(drawn.directions[i])) > 0.0) {
                blocked += drawn.occluded[i];
            }
        }
        EXPECT_EQ(blocked, 0u) << "shadow rays that do not reach their light";
        const double mean = sum / samples, deviation = std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples);
        EXPECT_NEAR(mean, c.irradiance, 4.5 * deviation + 1e-5 * c.irradiance);
    }

    uint misplaced_ = 0;

private:
    void check_directions(const Case& c, const DeviceScene& scene, const LightSamples& drawn)
    {
        constexpr int fine = 24;
        const DirectionGrid grid{.rows = 8, .columns = 12, .cap = c.cap, .frame = Frame3d(c.towards)};
        std::vector<double> expected = grid.expected(densities(scene, c.position, grid.midpoints(fine)), fine, samples);
        std::vector<double> counts(grid.bins(), 0.0);
        const double probability = flatten_scene(c.scene).lights[0].probability;
        for (std::size_t i = 0; i < samples; ++i) counts[drawn.pdfs[i] > 0.0f ? grid.bin(drawn.directions[i]) : grid.bins() - 1] += 1.0;
        const double inside = std::accumulate(expected.begin(), expected.end(), 0.0);
        // Light 0 is in the cone, and all of it seen from its front: the density integrates to the chance of its choice.
        EXPECT_NEAR(inside / samples, probability, 5e-3 * probability);
        expected.back() = samples * (1.0 - probability);
        for (std::size_t bin = 0; bin + 1 < expected.size(); ++bin)
            expected[bin] *= samples * probability / inside; // the quadrature's error at edges
        EXPECT_TRUE(follows(counts, expected, tests_in_file));
    }
};

// [Lambert 1760]: irradiance at p from a polygon of radiance 1, all above the horizon.
double polygon_irradiance(Vec3d p, Vec3d normal, const std::vector<Vec3d>& corners)
{
    Vec3d sum;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = normalized(corners[i] - p), b = normalized(corners[(i + 1) % corners.size()] - p);
        sum = sum + normalized(cross(a, b)) * std::acos(dot(a, b));
    }
    return 0.5 * std::abs(dot(sum, normal));
}

const Vec3 up{0, 0, 1};

TEST_F(Lights, TriangleNearAndObliqueToo)
{
    const Vec3 a{0.2f, -0.5f, 1.0f}, b{0.9f, 0.4f, 1.4f}, c{-0.8f, 0.6f, 0.8f};
    const Vec3d center = (Vec3d(a) + Vec3d(b) + Vec3d(c)) / 3.0;
    // Its front is seen from below: clockwise from above. A point light shares the choice.
    Scene scene = SceneBuilder().light(triangle(a, c, b), {2, 2, 2}).emitter(PointEmitter{{0, -3, 4}, {4, 4, 4}}).scene;
    check({"triangle", scene, {0, 0, 0}, up, center, 0.7, 2.0 * polygon_irradiance({0, 0, 0}, up, {a, b, c}) + 4.0 * 0.8 / 25.0});
}

TEST_F(Lights, SphereFromNearFarAndInside)
{
    const auto sphere_scene = [](bool flipped) { return SceneBuilder().light(Sphere{{0.1f, 0.2f, 0.3f}, 0.5f, flipped}, {3, 3, 3}).scene; };
    const auto outside = [&](const char* name, double distance, Vec3d direction) {
        const Vec3d towards = normalized(direction);
        const double sine = 0.5 / distance;
        // The whole sphere lies above the horizon: E = pi L (R / d)^2 cos.
        const double cap = sine * sine / (1.0 + std::sqrt(1.0 - sine * sine));
        check({name, sphere_scene(false), to_float(Vec3d(Vec3{0.1f, 0.2f, 0.3f}) - towards * distance), up, towards, 1.05 * cap,
               3.0 * pi * sine * sine * towards.z});
    };
    outside("far", 40.0, {0.3, 0.2, 0.9});
    outside("near", 0.51, {0.01, 0.02, 1.0});
    outside("almost touching", 0.50002, {0.0, 0.0, 1.0});
    check({"inside", sphere_scene(true), {0.2f, 0.4f, 0.4f}, up, {0, 0, 1}, 2.0, 3.0 * pi});
}

// Irradiance at the origin from the cylinder about the z axis through (center, 0), from z = -half to half, of radiance 1:
// cos cos' / d^2 integrated over the part whose normals face the origin (or, flipped, all of it, which is around it).
double cylinder_irradiance(Vec3d normal, double center, double radius, double half, bool flipped)
{
    const double reach = flipped ? pi : std::acos(radius / center);
    constexpr int steps = 2000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double phi = reach * (2.0 * (i + 0.5) / steps - 1.0), z = half * (2.0 * (j + 0.5) / steps - 1.0);
            const Vec3d outwards(-std::cos(phi), std::sin(phi), 0);
            const Vec3d p = Vec3d(center, 0, z) + outwards * radius;
            const double d2 = dot(p, p);
            sum += std::max(0.0, dot(p, normal)) * std::abs(dot(p, outwards)) / (d2 * d2);
        }
    return sum * (2.0 * reach / steps) * (2.0 * half / steps) * radius;
}

TEST_F(Lights, CylinderFromOutsideAndInside)
{
    const auto cylinder_scene = [](float center, float radius, float half, bool flipped) {
        const Cylinder cylinder{.start = {center, 0, -half}, .radius = radius, .length = 2.0f * half, .flip_normals = flipped};
        return SceneBuilder().light(cylinder, {3, 3, 3}).scene;
    };
    const Vec3d across = normalized(Vec3d(1, 0.2, 0));
    check({"inside", cylinder_scene(0.25f, 0.5f, 1, true), {0, 0, 0}, to_float(across), {0, 0, 1}, 2.0,
           3.0 * cylinder_irradiance(across, 0.25, 0.5, 1, true)});

    // From outside the density grows without bound towards the silhouette, where no quadrature follows it: it is compared
    // sample by sample instead.
    const Case outside{"outside", cylinder_scene(2, 0.5f, 1, false), {0, 0, 0}, to_float(across), {1, 0, 0}, 0.0,
                       3.0 * cylinder_irradiance(across, 2, 0.5, 1, false)};
    const DeviceScene scene(device_, outside.scene);
    const LightSamples drawn = sample(scene, outside.position, outside.normal);
    check_irradiance(outside, drawn);
    const std::vector<float> expected = densities(scene, outside.position, {drawn.directions.begin(), drawn.directions.end()});
    std::size_t lit = 0, missed = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        if (drawn.pdfs[i] == 0.0f) continue;
        ++lit;
        missed += expected[i] == 0.0f;
        // pdf = d^2 / (A cos'), d >= 1.5. Positions are off by 1e-6, which turns the normal and cos' by as much over it.
        const double area = 2 * pi * 0.5 * 2, cosine = 1.5 * 1.5 / (area * drawn.pdfs[i]);
        if (cosine > 0.02 && expected[i] > 0.0f) {
            ASSERT_NEAR(drawn.pdfs[i], expected[i], 1e-2 * expected[i]) << "sample " << i;
        }
    }
    // The part of the area whose normals face the point: deviation sqrt(p (1 - p) / n), 4.5 of them.
    const double seen = std::acos(0.5 / 2.0) / pi;
    EXPECT_NEAR(static_cast<double>(lit) / samples, seen, 4.5 * std::sqrt(seen * (1 - seen) / samples));
    // Rays to the silhouette pass by it within rounding: cos' below sqrt(1e-6), a part of about as much of the area.
    EXPECT_LT(missed, 2e-3 * static_cast<double>(lit));
}

// Seen from far off, what rounding does to shadow rays is larger than the light's own coordinates would tell.
TEST_F(Lights, SmallLightsNearTheOriginReachFarSurfaces)
{
    const Vec3d from = normalized({0.3, -0.4, 0.6});
    const Frame3d frame(from);
    const float size = 0.5f;
    const Scene disk = SceneBuilder().light(Disk{{0, 0, 0}, to_float(frame.s * size), to_float(frame.t * size)}, {1, 1, 1}).scene;
    const TriangleMesh facing = triangle(to_float(frame.s * size), to_float(frame.t * size), to_float(frame.s * -size));
    const Scene mesh = SceneBuilder().light(facing, {1, 1, 1}).scene;
    const Scene sphere = SceneBuilder().light(Sphere{{0, 0, 0}, size, false}, {1, 1, 1}).scene;
    const Scene cylinder = SceneBuilder().light(Cylinder{.start = {0, 0, -size}, .radius = size, .length = 2 * size}, {1, 1, 1}).scene;
    for (const Scene* scene : {&disk, &mesh, &sphere, &cylinder}) {
        const DeviceScene device_scene(device_, *scene);
        for (const double distance : {10.0, 300.0, 5000.0}) {
            const LightSamples drawn = sample(device_scene, to_float(from * distance), to_float(-from));
            uint blocked = 0;
            for (std::size_t i = 0; i < samples; ++i) blocked += drawn.pdfs[i] > 0.0f ? drawn.occluded[i] : 0u;
            EXPECT_EQ(blocked, 0u) << "blocked by the light itself, " << distance << " away";
        }
    }
}

TEST_F(Lights, DiskOverItsCentre)
{
    // Coaxial: E = pi L R^2 / (R^2 + d^2). Its normal looks down.
    const Scene scene = SceneBuilder().light(Disk{{0, 0, 2}, {0, 1.5f, 0}, {1.5f, 0, 0}}, {5, 5, 5}).scene;
    check({"disk", scene, {0, 0, 0}, up, {0, 0, 1}, 1.05 * (1.0 - 0.8), 5.0 * pi * 1.5 * 1.5 / (1.5 * 1.5 + 4.0)});
}

TEST_F(Lights, ConstantEnvironment)
{
    SceneBuilder builder;
    builder.emitter(ConstantEmitter{{0.7f, 0.7f, 0.7f}}).shape(Sphere{{0, 0, -50}, 0.01f});
    check({"constant", builder.scene, {0, 0, 0}, up, {0, 0, 1}, 2.0, 0.7 * pi});
}

// Of several sizes, one row and one column among them. The quadrature's error at the borders of bins is that of a
// density which jumps by at most 3000 times its mean in one of `fine`^2 parts: maps without a sun keep it below the
// 5e-3 that are allowed; a sun's irradiance is tested below.
TEST_F(Lights, EnvironmentMap)
{
    for (const auto& [width, height] : {std::pair{8, 5}, std::pair{64, 33}, std::pair{1, 4}, std::pair{6, 1}}) {
        SceneBuilder builder;
        const EnvironmentEmitter map = turned_environment(random_environment(width, height, 1.0f), 0.6f);
        builder.emitter(map).shape(Sphere{{0, 0, -50}, 0.01f});
        const double irradiance = PlainEnvironment(map).integrate([](Vec3d d, double radiance) { return radiance * std::max(d.z, 0.0); });
        check({"environment map", builder.scene, {0, 0, 0}, up, {0, 0, 1}, 2.0, irradiance});
    }
}

TEST_F(Lights, EnvironmentMapWithASunBesidesALamp)
{
    SceneBuilder builder;
    const EnvironmentEmitter map = turned_environment(random_environment(64, 33));
    builder.emitter(PointEmitter{{0, 0, 4}, {500, 500, 500}}).emitter(map).shape(Sphere{{0, 0, -50}, 0.01f});
    const DeviceScene scene(device_, builder.scene);
    const FlatScene flat = flatten_scene(builder.scene);
    const PlainEnvironment plain(map);
    const LightSamples drawn = sample(scene, {0, 0, 0}, up);
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < samples; ++i) {
        const double e = drawn.radiance[i].x * std::max(0.0f, drawn.directions[i].z);
        sum += e;
        squares += e * e;
        if (drawn.pdfs[i] == 0.0f) continue; // the lamp
        const double density = plain.density(drawn.directions[i]) * flat.lights[1].probability;
        // Beside a patch's border a rounded direction may fall into the next one.
        if (std::abs(drawn.pdfs[i] / density - 1.0) > 1e-3) misplaced_++;
    }
    EXPECT_LT(misplaced_, samples / 1000);
    const double expected = plain.integrate([](Vec3d d, double radiance) { return radiance * std::max(d.z, 0.0); }) + 500.0 / 16.0;
    const double mean = sum / samples, deviation = std::sqrt((squares / samples - mean * mean) / samples);
    EXPECT_LT(deviation, 0.02 * expected);
    EXPECT_NEAR(mean, expected, 4.5 * deviation);
}

// What a ray that leaves the scene finds.
TEST_F(Lights, EnvironmentMapAsItIsSeen)
{
    for (const auto& [width, height] : {std::pair{64, 33}, std::pair{1, 4}, std::pair{6, 1}, std::pair{5, 2}}) {
        const EnvironmentEmitter map = turned_environment(random_environment(width, height), 0.25f);
        const PlainEnvironment plain(map);
        const DeviceScene scene(device_, SceneBuilder().emitter(map).shape(Sphere{}).scene);
        const Kernel kernel = test_kernel(R"(
            #include "scene/lights.h"
            __kernel void test(SURFACE_PARAMETERS, uint count, __global Vec3* directions, __global Vec3* radiance, __global float* pdfs)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const SurfaceView scene = SURFACE_VIEW;
                const float3 direction = sample_sphere(random4(i, 13u).xy);
                const EnvironmentValue value = environment_value(&scene, direction);
                directions[i] = pack(direction);
                radiance[i] = pack(value.radiance);
                pdfs[i] = value.pdf_w;
            })");
        const auto directions = allocate<Vec3>(samples), radiance = allocate<Vec3>(samples);
        const auto pdfs = allocate<float>(samples);
        kernel(samples, scene.surfaces(), samples, directions, radiance, pdfs);
        const auto d = directions.download(), l = radiance.download();
        const auto pdf = pdfs.download();
        int wrong_densities = 0;
        // Rounding moves a direction by 1e-6, and so a place between texels of at most 0.25 * 3000 * 12.
        const double error = 1e-6 * width * 0.25 * 3000 * 12;
        for (std::size_t i = 0; i < samples; ++i) {
            ASSERT_NEAR(l[i].x, plain.radiance(d[i]), error + 1e-5 * l[i].x);
            wrong_densities += std::abs(pdf[i] - plain.density(d[i])) > 1e-3 * plain.density(d[i]);
        }
        EXPECT_LT(wrong_densities, static_cast<int>(samples) / 1000); // beside a patch's border
    }
}

// Point-like lights: one direction, and an irradiance that does not vary.
TEST_F(Lights, PointSpotAndDirectional)
{
    const auto irradiance = [&](auto emitter, Vec3d expected_direction) {
        const DeviceScene scene(device_, SceneBuilder().emitter(emitter).shape(Sphere{{0, 0, -50}, 0.01f}).scene);
        const LightSamples drawn = sample(scene, {1, 0, 0}, up);
        EXPECT_EQ(drawn.pdfs[0], 0.0f);
        EXPECT_EQ(drawn.occluded[0], 0u);
        EXPECT_NEAR(length(Vec3d(drawn.directions[0]) - normalized(expected_direction)), 0.0, 1e-6);
        return drawn.radiance[0].x * dot(Vec3d(drawn.directions[0]), Vec3d(up));
    };
    const Vec3d to_light(2, 0, 2);
    const double cosine = std::sqrt(0.5);
    EXPECT_NEAR(irradiance(PointEmitter{{3, 0, 2}, {8, 8, 8}}, to_light), 8.0 * cosine / 8.0, 1e-5);
    const SpotEmitter spot{{3, 0, 2}, {0, 0, -1}, {8, 8, 8}, 1.0f, 0.5f}; // the point lies at pi / 4: (1 - pi / 4) / (1 - 0.5)
    EXPECT_NEAR(irradiance(spot, to_light), 8.0 * cosine / 8.0 * (1.0 - pi / 4) / 0.5, 1e-5);
    const Vec3 down = to_float(normalized({1, 0, -1}));
    EXPECT_NEAR(irradiance(DirectionalEmitter{down, {8, 8, 8}}, {-1, 0, 1}), 8.0 * cosine, 1e-5);
}

TEST_F(Lights, BehindAnAreaLightItIsDark)
{
    const DeviceScene disk(device_, SceneBuilder().light(Disk{{0, 0, 2}, {1, 0, 0}, {0, 1, 0}}, {5, 5, 5}).scene); // looks up
    const DeviceScene inside(device_, SceneBuilder().light(Sphere{{0, 0, 0}, 1.0f, false}, {5, 5, 5}).scene);
    for (const DeviceScene* scene : {&disk, &inside})
        for (const Vec3& radiance : sample(*scene, {0, 0.1f, 0}, up).radiance) ASSERT_EQ(radiance.x, 0.0f);
}

TEST_F(Lights, AreChosenByPowerAboveAFloor)
{
    SceneBuilder builder;
    std::vector<double> powers;
    for (int i = 0; i < 40; ++i) {
        const float intensity = i % 7 == 3 ? 0.0f : static_cast<float>(i * i) * 0.1f + 0.01f;
        builder.emitter(PointEmitter{{static_cast<float>(i), 0, 0}, {intensity, 0.5f * intensity, 0}});
        powers.push_back(intensity);
    }
    builder.shape(Sphere{{0, 0, 0}, 1.0f});
    const DeviceScene scene(device_, builder.scene);
    const Kernel kernel = test_kernel(R"(
        #include "scene/lights.h"
        __kernel void test(SURFACE_PARAMETERS, uint count, __global uint* chosen, __global float* probabilities)
        {
            uint i = get_global_id(0);
            if (i >= count) return;
            const SurfaceView scene = SURFACE_VIEW;
            const LightChoice choice = choose_light_by_power(&scene, random_words(i, 12u).x);
            chosen[i] = choice.light;
            probabilities[i] = choice.probability;
        })");
    const auto chosen = allocate<uint>(samples);
    const auto probabilities = allocate<float>(samples);
    kernel(samples, scene.surfaces(), samples, chosen, probabilities);
    const auto lights = chosen.download();
    const auto probability = probabilities.download();
    const double total = std::accumulate(powers.begin(), powers.end(), 0.0);
    const auto shining = static_cast<double>(std::count_if(powers.begin(), powers.end(), [](double power) { return power > 0.0; }));
    const auto chance = [&](double power) { return power > 0.0 ? (1.0 - emitter_floor) * power / total + emitter_floor / shining : 0.0; };
    std::vector<double> counts(powers.size(), 0.0), expected;
    for (std::size_t i = 0; i < samples; ++i) {
        counts.at(lights[i]) += 1.0;
        ASSERT_NEAR(probability[i], chance(powers[lights[i]]), 1e-6);
    }
    for (const double power : powers) expected.push_back(samples * chance(power));
    EXPECT_TRUE(follows(counts, expected, tests_in_file));
}

} // namespace
} // namespace sundog
