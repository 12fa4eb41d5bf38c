// Independent estimators agree: what different methods make of one scene differs by noise alone.

#include "scene/sensor_pose.h"
#include "support/cornell_scene.h"
#include "support/environment_probe.h"
#include "support/instanced_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

using namespace sundog;
using namespace sundog::test;

namespace {

constexpr int size = 32;
constexpr int blocks = 2; // an image is compared in blocks x blocks windows
constexpr int replicates = 12;

// Means of each window, one Estimate each, and of the whole image.
std::vector<Estimate> window_estimates(const Scene& scene, const RenderRequest& request)
{
    std::vector<std::vector<double>> values(blocks * blocks + 1);
    for (int seed = 1; seed <= replicates; seed++) {
        const Image image = render_sampled(scene, request, seed);
        constexpr int step = size / blocks;
        for (int by = 0; by < blocks; by++)
            for (int bx = 0; bx < blocks; bx++)
                values[static_cast<std::size_t>(by * blocks + bx)].push_back(window_mean(image, bx * step, by * step, (bx + 1) * step, (by + 1) * step));
        values.back().push_back(image_mean(image));
    }
    std::vector<Estimate> estimates;
    for (const auto& v : values) estimates.push_back(estimate_from(v));
    return estimates;
}

bool uses_photons(const RenderRequest& request)
{
    return request.method != "path" && request.method != "ptracer" && request.method != "bdpt" && request.method != "upg" && request.method != "pssmlt";
}

// The same methods share most of their kernels and all of a scene, so that a few for each scene find what breaks; the long tier
// compares them all.
enum class Tier { quick, thorough };

class Agreement : public testing::TestWithParam<Tier>
{
protected:
    void expect_agreement(const Scene& scene, std::vector<RenderRequest> requests, const std::vector<RenderRequest>& more, double bias);
};

INSTANTIATE_TEST_SUITE_P(Few, Agreement, testing::Values(Tier::quick), [](const auto&) { return "methods"; });
INSTANTIATE_TEST_SUITE_P(LongAll, Agreement, testing::Values(Tier::thorough), [](const auto&) { return "methods"; });

void expect_agreement_of(const Scene& scene, const std::vector<RenderRequest>& requests, double bias);

void Agreement::expect_agreement(const Scene& scene, std::vector<RenderRequest> requests, const std::vector<RenderRequest>& more, double bias)
{
    if (GetParam() == Tier::thorough) requests.insert(requests.end(), more.begin(), more.end());
    expect_agreement_of(scene, requests, bias);
}

// bias: relative error that density estimation is known to make, allowed on top of noise.
void expect_agreement_of(const Scene& scene, const std::vector<RenderRequest>& requests, double bias)
{
    std::vector<std::vector<Estimate>> estimates;
    for (const auto& request : requests) estimates.push_back(window_estimates(scene, request));
    const double comparisons = static_cast<double>(requests.size() * (requests.size() - 1) / 2 * estimates[0].size());
    // Bonferroni at a family-wise 1%, two-sided, with the degrees of freedom of two equal samples.
    const double quantile = student_quantile(replicates - 1, 0.005 / comparisons);
    for (std::size_t a = 0; a < requests.size(); a++) {
        for (std::size_t b = a + 1; b < requests.size(); b++) {
            for (std::size_t w = 0; w < estimates[a].size(); w++) {
                const Estimate &x = estimates[a][w], &y = estimates[b][w];
                const double error = std::hypot(x.standard_error, y.standard_error);
                const bool biased = uses_photons(requests[a]) || uses_photons(requests[b]);
                EXPECT_NEAR(x.mean, y.mean, quantile * error + (biased ? bias * x.mean : 0.0)) << requests[a].method << " and " << requests[b].method << ", window " << w;
                // The test has power. (Windows with the edge of a light in them, 50 times as bright, are the noisy ones.)
                EXPECT_LT(error, 0.05 * allowed_noise() * x.mean) << requests[a].method << " and " << requests[b].method << ", window " << w;
            }
        }
    }
}

RenderRequest request(const std::string& method, std::uint64_t iterations, const std::string& extra = "", const std::string& value = "")
{
    RenderRequest r{method, iterations, {{"max_depth", "6"}}};
    if (method == "pssmlt")
        r.parameters.insert({{"chains", "4096"}, {"seeds", "8192"}});
    else
        r.parameters["sampler"] = "independent";
    if (method != "path" && method != "pssmlt") r.parameters["photons"] = method == "bdpt" || method == "vcm" || method == "upg" ? "2048" : "16384";
    if (uses_photons(r) || method == "upg") r.parameters["radius"] = "0.01";
    if (method == "photonmapper") r.parameters["caustic_radius"] = "0.01";
    if (!extra.empty()) r.parameters[extra] = value;
    return r;
}

// A disk of radius r at a wall's edge loses 2 / (3 pi) of its photons on average over a strip of width r; in a box
// of side 2 the strips of all edges cover 2 r of each wall's area, so a radius of 0.01 darkens light from photons by
// 2 * 0.01 * 0.21 = 0.4% (the kernel's own blur, of order r^2, is below 0.1%).
constexpr double edge_bias = 0.005;

TEST_P(Agreement, DiffuseBox)
{
    expect_agreement(cornell_box(size),
                     {request("path", 64), request("ptracer", 16), request("pppm", 16), request("photonmapper", 16), request("bdpt", 32, "connections", "resampled"),
                      request("bdpt", 32), request("vcm", 32), request("bpm", 16), request("upg", 24), request("pssmlt", 12)},
                     {request("sppm", 16), request("pppm", 16, "direct", "photons"), request("appm", 16), request("pssmlt", 16, "paths", "path")}, edge_bias);
}

Scene glass_and_mirror_box()
{
    Scene scene = cornell_box(size);
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    const uint mirror = add_bsdf(scene, ConductorBsdf{});
    scene.shapes.push_back(make_sphere({.45f, -.6f, .3f}, .4f, glass));
    scene.shapes.push_back(make_sphere({-.45f, -.6f, -.3f}, .4f, mirror));
    return scene;
}

// Light tracing cannot see what is behind glass, so the others are compared.
TEST_P(Agreement, GlassAndMirrorSpheres)
{
    expect_agreement(glass_and_mirror_box(), {request("path", 256), request("pppm", 24), request("bdpt", 64), request("vcm", 48)},
                     {request("sppm", 24), request("cppm", 24), request("ppm", 24), request("photonmapper", 24, "relaxation", "5"), request("bpm", 24),
                      request("upg", 64), request("pssmlt", 32, "paths", "path"), request("pssmlt", 20)}, edge_bias);
}

AnimatedTransform between(const Transform& from, const Transform& to)
{
    return AnimatedTransform(std::vector<TransformKey>{{0, from}, {1, to}});
}

void add_moving(Scene& scene, const ShapeDescription& shape, const AnimatedTransform& to_world)
{
    scene.shapes.push_back(shape);
    make_instances(scene, scene.shapes.size() - 1, {Transform()});
    scene.instances.back().to_world = to_world;
}

// Seen by a camera that moves: a glass ball that crosses under the light, with its caustic, and a turning mirror.
Scene moving_box()
{
    Scene scene = cornell_box(size);
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    const uint mirror = add_bsdf(scene, ConductorBsdf{});
    const uint both_sides = add_bsdf(scene, TwoSidedBsdf{mirror, mirror});
    add_moving(scene, make_sphere({0, 0, 0}, 0.35f, glass),
               between(Transform::translate({-.5, -.5, .3}), Transform::translate({.5, -.3, .3})));
    add_moving(scene, make_quad({-.3f, -.3f, 0}, {.3f, -.3f, 0}, {.3f, .3f, 0}, {-.3f, .3f, 0}, both_sides),
               between(Transform::translate({.3, .2, -.4}), Transform::translate({-.3, .3, -.4}) * Transform::rotate({1, 2, 0}, 150)));
    scene.sensor.shutter = {0, 1};
    const Transform pose = pose_of(scene.sensor);
    scene.sensor.motion = between(pose, Transform::translate({.3, .1, 0}) * Transform::rotate({0, 1, 0}, 4) * pose);
    return scene;
}

TEST_P(Agreement, MovingGlassMirrorAndCamera)
{
    expect_agreement(moving_box(), {request("path", 96), request("pppm", 12)}, {request("sppm", 12), request("upg", 24)}, edge_bias);
}

// Where light tracing sees all: the camera looks past the ball and the mirror at their caustics, and at a turning block.
TEST_P(Agreement, MovingCausticsAndCamera)
{
    Scene scene = moving_box();
    const Transform to_floor = *Transform::look_at({0, .9, .9}, {0, -1, .1}, Double3{0, 0, -1});
    scene.sensor.motion = between(to_floor, Transform::translate({.1, 0, 0}) * to_floor);
    set_pose(to_floor, scene.sensor);
    scene.sensor.fov_x = 0.4f;
    scene.instances[0].to_world = between(Transform::translate({-.7, .3, -.5}), Transform::translate({.7, .3, -.4}));
    scene.instances[1].to_world =
        between(Transform::translate({-.6, -.6, -.6}), Transform::translate({-.6, -.4, -.6}) * Transform::rotate({1, 2, 0}, 150));
    add_moving(scene, make_quad({-.2f, 0, 0}, {.2f, 0, 0}, {.2f, .3f, 0}, {-.2f, .3f, 0}, 1),
               between(Transform::translate({-.2, -.9, .1}), Transform::translate({.2, -.8, .1}) * Transform::rotate({0, 1, 0}, 60)));
    expect_agreement(scene, {request("path", 96), request("ptracer", 12), request("vcm", 24)}, {request("pppm", 12), request("sppm", 12)}, edge_bias);
}

// Broad reflections are asked for photons; narrow ones are followed, and asked only for what no followed path finds.
Scene rough_metals_box()
{
    Scene scene = cornell_box(size);
    const Vec3 eta{0.2f, 0.9f, 1.1f}, k{3.9f, 2.5f, 2.1f};
    const uint broad = add_bsdf(scene, ConductorBsdf{eta, k, {}, Roughness{false, 0.4f, 0.25f}});
    const uint narrow = add_bsdf(scene, ConductorBsdf{eta, k, {}, Roughness{true, 0.1f, 0.1f}});
    scene.shapes.push_back(make_sphere({.45f, -.6f, .3f}, .4f, broad));
    scene.shapes.push_back(make_sphere({-.45f, -.6f, -.3f}, .4f, narrow));
    return scene;
}

TEST_P(Agreement, RoughMetals)
{
    expect_agreement(rough_metals_box(), {request("path", 256), request("pppm", 48), request("vcm", 48)},
                     {request("ptracer", 48), request("sppm", 48), request("pppm", 48, "direct", "photons"), request("bdpt", 48), request("bpm", 48), request("upg", 48),
                      request("pssmlt", 24)}, edge_bias);
}

Scene ground_glass_box()
{
    Scene scene = cornell_box(size);
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {}, {}, Roughness{false, 0.5f, 0.5f}});
    scene.shapes.push_back(make_sphere({0, -.5f, .2f}, .45f, glass));
    return scene;
}

TEST_P(Agreement, GroundGlass)
{
    expect_agreement(ground_glass_box(), {request("path", 256), request("pppm", 48), request("vcm", 48)},
                     {request("ptracer", 48), request("sppm", 48), request("bdpt", 48), request("bpm", 48), request("upg", 48), request("pssmlt", 24)}, edge_bias);
}

TEST(LongAgreement, PhotonMapperBesidesGlassAndRoughLobes)
{
    expect_agreement_of(cornell_box(size), {request("path", 64), request("photonmapper", 16, "final_gather", "false")}, edge_bias);
    expect_agreement_of(glass_and_mirror_box(), {request("path", 256), request("photonmapper", 24), request("photonmapper", 24, "direct", "photons")}, edge_bias);
    for (const Scene& scene : {rough_metals_box(), ground_glass_box()}) expect_agreement_of(scene, {request("path", 256), request("photonmapper", 48)}, edge_bias);
}

// A point light, by way of a mirror in front of the box that the camera does not see, on narrow metal: neither can the
// light be hit nor the mirror be connected, so only light paths and photons find it.
TEST_P(Agreement, MirroredPointLightOnNarrowMetal)
{
    Scene scene = cornell_box(size);
    scene.shapes.pop_back(); // the box's own light
    scene.emitters.push_back({{}, PointEmitter{{.1f, .6f, 2.2f}, {6, 6, 6}}});
    const uint mirror = add_bsdf(scene, ConductorBsdf{});
    const uint narrow = add_bsdf(scene, ConductorBsdf{{0.2f, 0.9f, 1.1f}, {3.9f, 2.5f, 2.1f}, {}, Roughness{false, 0.12f, 0.12f}});
    scene.shapes.push_back(make_quad({-1, -1, 1.2f}, {-1, -1, 3}, {1, -1, 3}, {1, -1, 1.2f}, mirror));
    scene.shapes.push_back(make_sphere({0, -.35f, .2f}, .6f, narrow));
    expect_agreement(scene, {request("ptracer", 96), request("pppm", 64), request("vcm", 96)},
                     {request("sppm", 64), request("pppm", 64, "direct", "photons"), request("photonmapper", 64), request("bdpt", 96), request("bpm", 64), request("upg", 96), request("pssmlt", 24)}, edge_bias);
}

// The two lobes of plastic, and the parts of a mask and a blend, are chosen anew by each path.
Scene plastic_spheres(const PlasticBsdf& model)
{
    Scene scene = cornell_box(size);
    const uint plastic = add_bsdf(scene, model);
    const uint blend = add_bsdf(scene, BlendBsdf{0.4f, {0, plastic}});
    const uint mask = add_bsdf(scene, MaskBsdf{0.6f, plastic});
    scene.shapes.push_back(make_sphere({.5f, -.65f, .3f}, .33f, plastic));
    scene.shapes.push_back(make_sphere({-.4f, .2f, -.3f}, .33f, blend));
    scene.shapes.push_back(make_sphere({.4f, .2f, -.3f}, .33f, mask));
    return scene;
}

TEST_P(Agreement, RoughPlasticMaskAndBlend)
{
    const Scene scene = plastic_spheres(PlasticBsdf{1.5f, 1.0f, {.2f, .3f, .7f}, {1, 1, 1}, false, Roughness{false, 0.3f, 0.3f}});
    expect_agreement(scene, {request("path", 256), request("pppm", 48), request("vcm", 48)}, {request("ptracer", 48), request("sppm", 48), request("bdpt", 48)}, edge_bias);
}

// Without ptracer, to which what a smooth coat mirrors is invisible.
TEST_P(Agreement, SmoothPlasticMaskAndBlend)
{
    const Scene scene = plastic_spheres(PlasticBsdf{1.5f, 1.0f, {.6f, .3f, .1f}, {1, 1, 1}, true});
    expect_agreement(scene, {request("path", 256), request("pppm", 48), request("vcm", 64)}, {request("sppm", 48), request("photonmapper", 48, "final_gather", "false"), request("bdpt", 64)}, edge_bias);
}

// Each part of the principled BSDF somewhere: cloth under a coat, brushed metal, tinted ground glass.
TEST_P(Agreement, Principled)
{
    Scene scene = cornell_box(size);
    PrincipledBsdf cloth, metal, glass;
    cloth.base_color = ColorSource(.7f, .3f, .2f);
    cloth.roughness = .9f;
    cloth.sheen = 1.0f;
    cloth.flatness = .5f;
    cloth.clearcoat = 1.0f;
    metal.base_color = ColorSource(.9f, .6f, .3f);
    metal.metallic = .8f;
    metal.roughness = .6f;
    metal.anisotropic = .5f;
    metal.spec_tint = .5f;
    glass.base_color = ColorSource(.6f, .8f, .9f);
    glass.roughness = .7f;
    glass.spec_trans = .7f;
    scene.shapes.push_back(make_sphere({.5f, -.65f, .3f}, .33f, add_bsdf(scene, cloth)));
    scene.shapes.push_back(make_sphere({-.4f, .2f, -.3f}, .33f, add_bsdf(scene, metal)));
    scene.shapes.push_back(make_sphere({-.3f, -.6f, .2f}, .38f, add_bsdf(scene, glass)));
    expect_agreement(scene, {request("path", 96), request("pppm", 16), request("vcm", 32)}, {request("ptracer", 16), request("photonmapper", 16), request("upg", 32)}, edge_bias);
}

// A lobe that is asked for photons, and one that is followed.
TEST_P(Agreement, Phong)
{
    Scene scene = cornell_box(size);
    const uint broad = add_bsdf(scene, PhongBsdf{{.3f, .2f, .1f}, {.6f, .6f, .6f}, 6.0f});
    const uint narrow = add_bsdf(scene, PhongBsdf{{.1f, .2f, .3f}, {.5f, .6f, .7f}, 60.0f});
    scene.shapes.push_back(make_sphere({.45f, -.6f, .3f}, .4f, broad));
    scene.shapes.push_back(make_sphere({-.45f, -.6f, -.3f}, .4f, narrow));
    expect_agreement(scene, {request("path", 96), request("pppm", 16), request("vcm", 32)}, {request("ptracer", 16), request("upg", 32)}, edge_bias);
}

// A layer that absorbs over a diffuse base, which is asked for photons, and a rough one over metal.
TEST_P(Agreement, Coatings)
{
    Scene scene = cornell_box(size);
    const auto coated = [&](uint nested, std::optional<Roughness> roughness) {
        CoatingBsdf coating;
        coating.sigma_a = {.1f, .3f, .5f};
        coating.roughness = roughness;
        coating.nested = nested;
        return add_bsdf(scene, coating);
    };
    const uint base = add_bsdf(scene, DiffuseBsdf{{.8f, .7f, .6f}}), metal = add_bsdf(scene, ConductorBsdf{{0, 0, 0}, {1, 1, 1}, {.9f, .9f, .9f}, Roughness{false, .4f, .4f}});
    scene.shapes.push_back(make_sphere({.45f, -.6f, .3f}, .4f, coated(base, std::nullopt)));
    scene.shapes.push_back(make_sphere({-.45f, -.6f, -.3f}, .4f, coated(metal, Roughness{true, .3f, .3f})));
    expect_agreement(scene, {request("path", 96), request("sppm", 32), request("vcm", 32)}, {request("ptracer", 16), request("pppm", 16), request("upg", 32)}, edge_bias);
}

// An 8 x 8 bitmap that is different in each texel, and the relief that it makes of a wall with texture coordinates.
uint add_relief(Scene& scene, bool normals, uint nested)
{
    TexelImage image;
    image.width = image.height = 8;
    image.format = TexelFormat::linear8;
    for (uint i = 0; i < 64; i++) image.texels.push_back((96 + 37 * i % 64) | (96 + 53 * i % 64) << 8 | (normals ? 240u : 128u) << 16);
    scene.textures.push_back({"",
                              {},
                              {1, 0, 0},
                              {0, 1, 0},
                              BitmapTexture{std::make_shared<const TexelImage>(image), WrapMode::repeat, WrapMode::repeat, TextureFilter::bilinear}});
    const uint texture = static_cast<uint>(scene.textures.size() - 1);
    // Normals are not turned round: which are would depend on the side that a path comes from.
    if (normals) return add_bsdf(scene, NormalMapBsdf{ColorSource(Vec3{1, 1, 1}, texture), false, true, nested});
    return add_bsdf(scene, BumpMapBsdf{NumberSource(0.3f, texture), false, true, nested});
}

TEST_P(Agreement, Relief)
{
    Scene scene = cornell_box(size);
    const uint metal = add_bsdf(scene, ConductorBsdf{{0.2f, 0.9f, 1.1f}, {3.9f, 2.5f, 2.1f}, {}, Roughness{false, 0.4f, 0.4f}});
    const uint bumps = add_relief(scene, false, 0), normals = add_relief(scene, true, metal);
    for (const uint bsdf : {bumps, normals}) {
        const float x = bsdf == bumps ? -.9f : .1f;
        ShapeDescription panel = make_quad({x, -.6f, -.3f}, {x + .8f, -.6f, -.3f}, {x + .8f, .4f, -.7f}, {x, .4f, -.7f}, bsdf);
        std::get<TriangleMesh>(panel.geometry).uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        scene.shapes.push_back(panel);
    }
    expect_agreement(scene, {request("path", 256), request("pppm", 48), request("vcm", 64)}, {request("ptracer", 48)}, edge_bias);
}

TEST_P(Agreement, ThinPaneAndDisk)
{
    Scene scene = cornell_box(size);
    const uint pane = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, true, {1, 1, 1}, {1, 1, 1}});
    const uint white = add_bsdf(scene, DiffuseBsdf{{0.7f, 0.7f, 0.7f}});
    const uint both_sides = add_bsdf(scene, TwoSidedBsdf{white, white});
    scene.shapes.push_back(make_quad({-.8f, .2f, -.8f}, {-.8f, .2f, .8f}, {.8f, .2f, .8f}, {.8f, .2f, -.8f}, pane));
    ShapeDescription disk;
    disk.geometry = Disk{{0, -.4f, 0}, {.5f, 0, 0}, {0, 0, .5f}};
    disk.bsdf = both_sides;
    scene.shapes.push_back(disk);
    expect_agreement(scene, {request("path", 256), request("pppm", 24), request("vcm", 48)}, {request("sppm", 24)}, edge_bias);
}

TEST_P(Agreement, EveryEmitter)
{
    // Sphere and disk lights, point, spot, directional and constant light together.
    Scene scene = cornell_box(size);
    scene.shapes.pop_back(); // the box's own light
    const uint black = add_bsdf(scene, DiffuseBsdf{{0, 0, 0}});
    ShapeDescription sphere = make_sphere({-.5f, .3f, 0}, .2f, black);
    sphere.emitter = AreaEmitter{{4, 4, 4}};
    scene.shapes.push_back(sphere);
    ShapeDescription disk;
    disk.geometry = Disk{{.5f, .9f, 0}, {.3f, 0, 0}, {0, 0, -.2f}};
    std::get<Disk>(disk.geometry).axis_v = {0, 0, .2f}; // u x v points down
    disk.bsdf = black;
    disk.emitter = AreaEmitter{{8, 8, 8}};
    scene.shapes.push_back(disk);
    scene.emitters.push_back({{}, PointEmitter{{0, 0, .5f}, {.5f, .5f, .5f}}});
    scene.emitters.push_back({{}, SpotEmitter{{.3f, .5f, .3f}, {0, -1, 0}, {2, 2, 2}, .5f, .3f}});
    scene.emitters.push_back({{}, DirectionalEmitter{normalize(Vec3{.2f, -.3f, -1}), {.5f, .5f, .5f}}});
    scene.emitters.push_back({{}, ConstantEmitter{{.2f, .2f, .2f}}});
    expect_agreement(scene, {request("path", 128), request("ptracer", 32), request("pppm", 32), request("vcm", 48), request("upg", 48)},
                     {request("sppm", 32), request("photonmapper", 32), request("bdpt", 48), request("bpm", 32), request("pssmlt", 32, "paths", "path"), request("pssmlt", 24)}, edge_bias);
}

// A lamp that shines through glass, seen in a mirror as well: no technique but merging and a chance hit joins what it lights
// to the camera there. The lamp is large, so that chance hits are frequent enough to tell whether methods that can do with
// small ones are right.
TEST_P(Agreement, LargeLampInGlass)
{
    Scene scene = cornell_box(size);
    scene.shapes.pop_back(); // the box's own light
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    const uint mirror = add_bsdf(scene, ConductorBsdf{});
    scene.shapes.push_back(make_sphere({.3f, -.3f, .1f}, .45f, glass));
    ShapeDescription lamp = make_sphere({.3f, -.3f, .1f}, .3f, 0);
    lamp.emitter = AreaEmitter{{3, 3, 3}};
    scene.shapes.push_back(lamp);
    scene.shapes.push_back(make_sphere({-.6f, -.6f, .2f}, .35f, mirror));
    expect_agreement(scene, {request("path", 192), request("pppm", 24), request("vcm", 48)},
                     {request("bdpt", 64), request("bpm", 24), request("upg", 64), request("pssmlt", 24), request("pssmlt", 24, "paths", "path"),
                      request("sppm", 24), request("cppm", 24)},
                     edge_bias);
}

TEST_P(Agreement, ManyLights)
{
    Scene scene = cornell_box(size);
    const ShapeDescription ceiling_light = scene.shapes.back();
    scene.shapes.pop_back();
    for (int i = 0; i < 64; i++) {
        const float x = -.85f + .24f * static_cast<float>(i % 8), z = -.85f + .24f * static_cast<float>(i / 8);
        ShapeDescription light = make_quad({x, .98f, z}, {x + .12f, .98f, z}, {x + .12f, .98f, z + .12f}, {x, .98f, z + .12f}, ceiling_light.bsdf);
        const float strength = 0.25f * static_cast<float>(1 + i * 37 % 64);
        light.emitter = AreaEmitter{{strength, strength, strength}};
        scene.shapes.push_back(light);
    }
    expect_agreement(scene, {request("path", 64, "light_choice", "tree"), request("ptracer", 16), request("vcm", 32)},
                     {request("path", 64, "light_choice", "power"), request("bdpt", 32), request("bdpt", 32, "light_choice", "tree"), request("pppm", 16),
                      request("bpm", 16), request("upg", 24), request("pssmlt", 16)},
                     edge_bias);
}

// The box without ceiling, back wall and lamp, with a ball, under a turned map.
Scene scene_under_a_map(std::shared_ptr<const TexelImage> image)
{
    Scene scene = cornell_box(size);
    scene.shapes.pop_back(); // the box's own light
    scene.shapes.erase(scene.shapes.begin() + 1, scene.shapes.begin() + 3); // ceiling and back wall
    scene.shapes.push_back(make_sphere({.1f, -.5f, 0}, .4f, 0));
    scene.emitters.push_back({{}, turned_environment(std::move(image), .3f)});
    return scene;
}

TEST_P(Agreement, EnvironmentMap)
{
    expect_agreement(scene_under_a_map(random_environment(16, 9, 30.0f)),
                     {request("path", 128), request("ptracer", 64), request("pppm", 32), request("vcm", 48)},
                     {request("sppm", 32), request("pppm", 32, "direct", "photons"), request("bdpt", 48), request("bpm", 32), request("upg", 48), request("pssmlt", 24)}, edge_bias);
}

// Both are one light: paths find the sun by either of two strategies, photons start from it. It stands behind the camera.
TEST_P(Agreement, SunAndSky)
{
    Scene scene = scene_under_a_map(random_environment(2, 2, 1.0f));
    SunSkyEmitter sunsky;
    sunsky.up = {0, 1, 0};
    sunsky.sun_direction = normalize(Vec3{.3f, .8f, .4f});
    scene.emitters[0].model = sunsky;
    expect_agreement(scene, {request("path", 64), request("ptracer", 64), request("sppm", 32)},
                     {request("pppm", 32, "direct", "photons"), request("vcm", 48), request("bdpt", 48), request("upg", 48)}, edge_bias);
}

TEST_P(Agreement, AWhiteMapIsAConstantEnvironment)
{
    TexelImage white{7, 4, TexelFormat::float32, std::vector<uint>(7 * 4 * 3, std::bit_cast<uint>(1.0f))};
    const Scene mapped = scene_under_a_map(std::make_shared<const TexelImage>(std::move(white)));
    Scene constant = mapped;
    constant.emitters[0].model = ConstantEmitter{{.3f, .3f, .3f}};
    for (const auto& r : {request("path", 32), request("ptracer", 32), request("pppm", 16)}) {
        const Estimate x = estimate_image_mean(mapped, r, replicates), y = estimate_image_mean(constant, r, replicates);
        const double error = std::hypot(x.standard_error, y.standard_error);
        EXPECT_NEAR(x.mean, y.mean, student_quantile(replicates - 1, 0.005 / 3) * error) << r.method;
        EXPECT_LT(error, 0.01 * allowed_noise() * x.mean) << r.method;
    }
}

// Into the box from its open side, off centre so that a mirrored or shifted image would show in the windows.
Scene orthographic_box()
{
    Scene scene = cornell_box(size);
    scene.sensor.projection = Projection::orthographic;
    scene.sensor.position = {.15f, -.1f, 3.9f};
    scene.sensor.extent_x = .8f;
    scene.sensor.extent_y = .7f;
    return scene;
}

TEST_P(Agreement, Orthographic)
{
    expect_agreement(orthographic_box(), {request("path", 64), request("ptracer", 16), request("vcm", 32)}, {request("pppm", 16), request("bdpt", 32), request("bpm", 16), request("upg", 32), request("pssmlt", 16)}, edge_bias);
}

TEST_P(Agreement, Telecentric)
{
    Scene scene = orthographic_box();
    scene.sensor.aperture_radius = .15f;
    scene.sensor.focus_distance = 3.5f;
    expect_agreement(scene, {request("path", 64), request("ptracer", 16), request("bdpt", 32)}, {}, edge_bias);
}

TEST_P(Agreement, PrincipalPointAndCrop)
{
    Scene scene = cornell_box(size);
    scene.film.width = 48;
    scene.film.height = 40;
    scene.film.crop_x = 12;
    scene.film.crop_y = 6;
    scene.sensor.principal_offset_x = .05f;
    scene.sensor.principal_offset_y = -.08f;
    expect_agreement(scene, {request("path", 64), request("ptracer", 16), request("pssmlt", 12)}, {}, edge_bias);
    scene.sensor.aperture_radius = .1f;
    scene.sensor.focus_distance = 3.9f;
    expect_agreement(scene, {request("path", 64), request("ptracer", 16)}, {}, edge_bias);
}

// What is nearer than the near plane neither shows nor hides: a black card before the camera changes nothing.
TEST_P(Agreement, NearPlaneBeyondACard)
{
    for (const bool orthographic : {false, true}) {
        Scene scene = orthographic ? orthographic_box() : cornell_box(size);
        const uint black = add_bsdf(scene, DiffuseBsdf{{0, 0, 0}});
        scene.shapes.push_back(make_quad({-.3f, -1, 3.5f}, {.3f, -1, 3.5f}, {.3f, 1, 3.5f}, {-.3f, 1, 3.5f}, black));
        scene.sensor.near_clip = .5f;
        expect_agreement(scene, {request("path", 64), request("ptracer", 16)}, {}, edge_bias);
    }
}

TEST_P(Agreement, ThinLensAndWideFilter)
{
    Scene scene = cornell_box(size);
    scene.sensor.aperture_radius = .1f;
    scene.sensor.focus_distance = 3.9f;
    scene.film.filter = {FilterKind::gaussian, 2.0f, 0.5f, 0, 0};
    expect_agreement(scene, {request("path", 64), request("ptracer", 16), request("pppm", 16)}, {}, edge_bias);
    scene.film.filter = {FilterKind::mitchell, 2.0f, 0.5f, 1.0f / 3, 1.0f / 3};
    expect_agreement(scene, {request("path", 64), request("ptracer", 16), request("pssmlt", 16)}, {request("pssmlt", 16, "paths", "path")}, edge_bias);
}

} // namespace
