// Lights with images: what they send out, and what a surface receives of them, is the image's light; and light sets out in
// the directions that its density says.
#include "scene/light_list.h"
#include "stages/device_scene.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"
#include "support/direction_grid.h"
#include "support/light_image.h"
#include "support/scene_builder.h"

#include <numeric>

namespace sundog
{
namespace
{

using std::numbers::pi;

constexpr int tests_in_file = 6;
constexpr uint samples = 100'000;
// A texel's neighbours differ by up to 4; rounding moves a place by 1e-6 of the image, 1e-5 of a texel.
constexpr double rounding = 2e-4;

class TexturedLights : public DeviceFixture
{
protected:
    struct Emission {
        std::vector<Ray> rays;
        std::vector<Vec3> flux;
    };

    Emission emit(const Scene& scene)
    {
        const DeviceScene device_scene(device_, scene);
        const Kernel kernel = test_kernel(R"(
            #include "scene/emission.h"
            __kernel void test(SURFACE_PARAMETERS, uint count, __global Ray* rays, __global Vec3* flux)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const SurfaceView scene = SURFACE_VIEW;
                const EmissionSample sample = sample_emission(&scene, random_words(i, 41u), random4(i, 42u).xy);
                rays[i] = sample.ray;
                flux[i] = pack(sample.flux);
            })",
                                          device_scene.surface_options());
        const auto rays = allocate<Ray>(samples);
        const auto flux = allocate<Vec3>(samples);
        kernel(samples, device_scene.surfaces(), samples, rays, flux);
        return {rays.download(), flux.download()};
    }

    struct Arrival {
        std::vector<Vec3> directions; // zero: none
        std::vector<Vec3> radiance;   // of area lights; of others radiant intensity over squared distance
        std::vector<Ray> shadow_rays;
    };

    // Light that arrives at random points of a cube of half side 1 about `middle`.
    Arrival receive(const DeviceScene& scene, Vec3 middle)
    {
        const Kernel kernel = test_kernel(R"(
            #include "scene/lights.h"
            __kernel void test(SURFACE_PARAMETERS, Vec3 middle, uint count, __global Vec3* directions, __global Vec3* radiance, __global Ray* shadow_rays)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const SurfaceView scene = SURFACE_VIEW;
                Surface surface;
                surface.position = unpack(middle) + 2.0f * random4(i, 43u).xyz - 1.0f;
                surface.geometric_normal = surface.shading_normal = surface.outgoing = (float3)(0.0f, 0.0f, 1.0f);
                surface.offset = 0.0f;
                surface.shape = surface.primitive = 0u;
                LightSample sample;
                const bool lit = sample_light(&scene, &surface, 0u, random_words(i, 44u), &sample);
                directions[i] = pack(lit ? sample.direction : (float3)(0.0f));
                const float density = sample.pdf_w == PDF_DELTA ? 1.0f : sample.pdf_w;
                radiance[i] = pack(lit ? sample.radiance * density : (float3)(0.0f));
                shadow_rays[i] = lit ? sample.shadow_ray : no_ray();
                shadow_rays[i].origin = pack(surface.position);
            })",
                                          scene.surface_options());
        const auto directions = allocate<Vec3>(samples), radiance = allocate<Vec3>(samples);
        const auto rays = allocate<Ray>(samples);
        kernel(samples, scene.surfaces(), middle, samples, directions, radiance, rays);
        return {directions.download(), radiance.download(), rays.download()};
    }

    // What paths find that run into the light by chance: radiance at the hits of rays.
    std::vector<Vec3> found(const DeviceScene& scene, std::vector<Ray> rays)
    {
        for (Ray& ray : rays) ray.t_max = ray.t_max == 0.0f ? 0.0f : INFINITY;
        std::vector<uint> active(samples);
        std::iota(active.begin(), active.end(), 0u);
        const auto device_rays = upload(rays);
        const auto hits = allocate<Hit>(samples);
        Kernel(device_, "trace_closest", "Trace", scene.trace_options())(samples, scene.geometry(), device_rays, hits, upload(active),
                                                                         upload(std::vector{samples}));
        const Kernel kernel = test_kernel(R"(
            #include "scene/lights.h"
            __kernel void test(SURFACE_PARAMETERS, uint count, __global const Ray* rays, __global const Hit* hits, __global Vec3* radiance)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const SurfaceView scene = SURFACE_VIEW;
                radiance[i] = pack((float3)(0.0f));
                if (hits[i].primitive == NO_PRIMITIVE) return;
                const Surface surface = surface_at(&scene, rays[i], hits[i]);
                radiance[i] = pack(emitted_radiance(&scene, &surface, light_of_hit(&scene, &surface)));
            })",
                                          scene.surface_options());
        const auto radiance = allocate<Vec3>(samples);
        kernel(samples, scene.surfaces(), samples, device_rays, hits, radiance);
        return radiance.download();
    }

    static double mean(const std::vector<Vec3>& values, double& deviation)
    {
        double sum = 0.0, squares = 0.0;
        for (const Vec3& value : values) {
            sum += value.x;
            squares += static_cast<double>(value.x) * value.x;
        }
        deviation = std::sqrt(std::max(0.0, squares / samples - sum / samples * (sum / samples)) / samples);
        return sum / samples;
    }
};

// An image of 7 x 5 texels, thrown along an axis that is none of the world's. Directions as the projection says: v of the
// image grows along -axis_y, u along -axis_x.
struct Thrown {
    Vec3d x, y, z;
    Vec3 position{0.3f, -0.2f, 0.1f};
    std::shared_ptr<const TexelImage> image = light_image(7, 5);

    Thrown()
    {
        const Frame3d frame(normalized({0.3, -0.5, 0.8}));
        x = frame.s, y = frame.t, z = frame.n;
    }
    // Place in [-1, 1]^2 of a direction, on an image of these half sides one unit away.
    std::array<double, 2> place(Vec3d d, double half_width, double half_height) const
    {
        return {dot(d, x) / dot(d, z) / half_width, dot(d, y) / dot(d, z) / half_height};
    }
};

TEST_F(TexturedLights, ProjectorSendsItsImage)
{
    const Thrown t;
    const double half_width = 0.7, half_height = 0.5;
    ProjectorEmitter projector{.position = t.position,
                               .axis_x = to_float(t.x),
                               .axis_y = to_float(t.y),
                               .axis_z = to_float(t.z),
                               .half_width = 0.7f,
                               .half_height = 0.5f,
                               .irradiance = {3, 3, 3},
                               .texture = {}};
    SceneBuilder builder;
    projector.texture = add_light_image(builder.scene, t.image);
    builder.emitter(projector).shape(Sphere{{50, 0, 0}, 0.1f});
    // I = E / cos^3; uniform in the image, the density of a direction is 1 / (area cos^3).
    const auto intensity = [&](Vec3d d) -> double {
        const auto p = t.place(d, half_width, half_height);
        const double cosine = dot(d, t.z);
        if (cosine <= 0.0 || std::max(std::abs(p[0]), std::abs(p[1])) > 1.0) return 0.0;
        return 3.0 * plain_image(*t.image, 0.5 - 0.5 * p[0], 0.5 - 0.5 * p[1]) / (cosine * cosine * cosine);
    };
    const auto density = [&](Vec3d d) -> double {
        const auto p = t.place(d, half_width, half_height);
        const double cosine = dot(d, t.z);
        if (cosine <= 0.0 || std::max(std::abs(p[0]), std::abs(p[1])) > 1.0) return 0.0;
        return 1.0 / (4.0 * half_width * half_height * cosine * cosine * cosine);
    };
    const Emission emission = emit(builder.scene);
    std::vector<Vec3d> directions;
    for (std::size_t i = 0; i < samples; ++i) {
        const Vec3d d = emission.rays[i].direction;
        directions.push_back(d);
        const auto p = t.place(d, half_width, half_height);
        if (std::max(std::abs(p[0]), std::abs(p[1])) > 1.0 - 1e-5) continue;
        ASSERT_NEAR(emission.flux[i].x * density(d), intensity(d), rounding * 3.0 * 4.0) << i;
    }
    const DirectionGrid grid{.rows = 8, .columns = 12, .cap = 0.3, .frame = Frame3d(t.z)};
    EXPECT_TRUE(follows(grid.count(directions), grid.expected(density, samples, 64), tests_in_file, 5e-3));

    const Vec3d middle = Vec3d(t.position) + t.z * 3.0;
    const Arrival arrival = receive(DeviceScene(device_, builder.scene), to_float(middle));
    std::size_t lit = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const Vec3d way = Vec3d(arrival.shadow_rays[i].origin) - Vec3d(t.position);
        const auto p = t.place(normalized(way), half_width, half_height);
        if (std::abs(std::max(std::abs(p[0]), std::abs(p[1])) - 1.0) < 1e-5) continue;
        lit += arrival.radiance[i].x > 0.0f;
        ASSERT_NEAR(arrival.radiance[i].x * dot(way, way), intensity(normalized(way)), 2.0 * rounding * 3.0 * 4.0) << i;
    }
    EXPECT_GT(lit, samples / 2);
}

TEST_F(TexturedLights, SpotSendsItsImage)
{
    const Thrown t;
    const double cutoff = 0.6, beam = 0.4, half = std::tan(cutoff);
    SpotEmitter spot{t.position, to_float(t.z), {3, 3, 3}, 0.6f, 0.4f};
    spot.axis_x = to_float(t.x);
    spot.axis_y = to_float(t.y);
    SceneBuilder builder;
    spot.texture = add_light_image(builder.scene, t.image);
    builder.emitter(spot).shape(Sphere{{50, 0, 0}, 0.1f});
    const auto intensity = [&](Vec3d d) -> double {
        const double angle = std::acos(std::min(1.0, dot(d, t.z)));
        const auto p = t.place(d, half, half);
        return angle >= cutoff
                   ? 0.0
                   : 3.0 * std::min(1.0, (cutoff - angle) / (cutoff - beam)) * plain_image(*t.image, 0.5 + 0.5 * p[0], 0.5 + 0.5 * p[1]);
    };
    const double cone = 2.0 * pi * (1.0 - std::cos(cutoff));
    const Emission emission = emit(builder.scene);
    std::vector<Vec3d> directions;
    // Near the axis the angle is only as good as the root of the cosine's rounding.
    for (std::size_t i = 0; i < samples; ++i) {
        const Vec3d d = emission.rays[i].direction;
        directions.push_back(d);
        ASSERT_NEAR(emission.flux[i].x / cone, intensity(d), 1e-3 * 3.0 * 4.0) << i;
    }
    const DirectionGrid grid{.rows = 8, .columns = 12, .cap = 1.0001 * (1.0 - std::cos(cutoff)), .frame = Frame3d(t.z)};
    EXPECT_TRUE(follows(grid.count(directions), grid.expected([&](Vec3d) { return 1.0 / cone; }, samples, 1), tests_in_file));

    const Arrival arrival = receive(DeviceScene(device_, builder.scene), to_float(Vec3d(t.position) + t.z * 3.0));
    std::size_t lit = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const Vec3d way = Vec3d(arrival.shadow_rays[i].origin) - Vec3d(t.position);
        lit += arrival.radiance[i].x > 0.0f;
        ASSERT_NEAR(arrival.radiance[i].x * dot(way, way), intensity(normalized(way)), 1e-3 * 3.0 * 4.0) << i;
    }
    EXPECT_GT(lit, samples / 2);
}

// A panel and a ball with images: the radiance that sampling them brings is what a ray to the same point finds, and the
// flux of emission is that radiance over the density of the point and the cosine.
TEST_F(TexturedLights, AreaLightsShineAsTheyAreSeen)
{
    for (const bool ball : {false, true}) {
        SceneBuilder builder;
        const auto image = light_image(8, 6);
        const uint texture = add_light_image(builder.scene, image);
        TriangleMesh panel = parallelogram({-1, -1, 4}, {0, 2, 0}, {2, 0, 0}); // seen from below
        panel.uvs = {{0, 0}, {0.9f, 0.1f}, {1, 1}, {0.1f, 0.9f}};
        if (ball)
            builder.light(Sphere{{0, 0, 4}, 1.2f}, {2, 2, 2});
        else
            builder.light(panel, {2, 2, 2});
        builder.scene.shapes.back().emitter->texture = texture;
        const DeviceScene scene(device_, builder.scene);
        const Arrival arrival = receive(scene, {0, 0, 0});
        const std::vector<Vec3> seen = found(scene, arrival.shadow_rays);
        std::size_t wrong = 0, lit = 0;
        for (std::size_t i = 0; i < samples; ++i) {
            lit += arrival.radiance[i].x > 0.0f;
            wrong += std::abs(arrival.radiance[i].x - seen[i].x) > 4.0 * rounding * 2.0 * 4.0;
        }
        EXPECT_GT(lit, samples / 2);
        EXPECT_LT(wrong, samples / 500) << "at the rim rays pass by, and the diagonal, where coordinates bend, is hit on its other side";

        const Emission emission = emit(builder.scene);
        // Traced back from just above where it begins.
        std::vector<Ray> back = emission.rays;
        for (Ray& ray : back) {
            ray.origin = ray.origin + ray.direction * 1e-2f;
            ray.direction = -ray.direction;
            ray.t_max = 1.0f;
        }
        const std::vector<Vec3> sent = found(scene, back);
        const double area = ball ? 4.0 * pi * 1.44 : 4.0;
        std::size_t astray = 0;
        for (std::size_t i = 0; i < samples; ++i)
            astray += std::abs(emission.flux[i].x - sent[i].x * pi * area) > 10.0 * rounding * 8.0 * pi * area;
        EXPECT_LT(astray, samples / 100) << "where rays leave so flat that they do not find back";
    }
}

// The parts of a panel that its image lights receive light paths as their power says, and the whole sends its power.
TEST_F(TexturedLights, EmissionAddsUpToThePower)
{
    SceneBuilder builder;
    const auto image = light_image(8, 6);
    const uint texture = add_light_image(builder.scene, image);
    TriangleMesh panel = parallelogram({0, 0, 1}, {0, 1, 0}, {2, 0, 0});
    panel.uvs = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    builder.light(panel, {3, 3, 3}).emitter(PointEmitter{{0, 0, 3}, {1, 1, 1}});
    builder.scene.shapes.back().emitter->texture = texture;
    double mean_value = 0.0;
    constexpr int steps = 600;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) mean_value += plain_image(*image, (i + 0.5) / steps, (j + 0.5) / steps) / (steps * steps);
    double deviation = 0.0;
    const double power = mean(emit(builder.scene).flux, deviation);
    EXPECT_NEAR(power, 3.0 * mean_value * 2.0 * pi + 4.0 * pi, 4.5 * deviation);
    // Chosen by the image's mean: about 12 sr W per m^2 against the lamp's 4 pi.
    const FlatScene flat = flatten_scene(builder.scene);
    EXPECT_NEAR(flat.light_strengths[0], 3.0 * mean_value, 0.15 * 3.0 * mean_value); // the brightest channel's
    EXPECT_EQ(flat.light_strengths[0], flat.light_strengths[1]);
}

// Values beyond what half floats hold reach the surface whole.
TEST_F(TexturedLights, BrightImagesAreNotClipped)
{
    TexelImage image{2, 1, TexelFormat::float32, {}};
    for (const float value : {3e5f, 3e5f, 3e5f, 3e5f, 3e5f, 3e5f}) image.texels.push_back(std::bit_cast<uint>(value));
    SceneBuilder builder;
    SpotEmitter spot{{0, 0, 2}, {0, 0, -1}, {1, 1, 1}, 1.2f, 1.0f};
    spot.texture = add_light_image(builder.scene, std::make_shared<const TexelImage>(image));
    builder.emitter(spot).shape(Sphere{{50, 0, 0}, 0.1f});
    const Emission emission = emit(builder.scene);
    float brightest = 0.0f;
    for (const Vec3& flux : emission.flux) brightest = std::max(brightest, flux.x);
    EXPECT_NEAR(brightest, 3e5 * 2.0 * pi * (1.0 - std::cos(1.2)), 10.0);
}

} // namespace
} // namespace sundog
