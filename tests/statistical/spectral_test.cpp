// Spectral transport: the same images as RGB transport where colours multiply once; methods agree on dispersion; prisms
// bend each colour by Snell's law; the same bits again, and after a resumption.
#include "scene/flat_scene.h"
#include "scene/wavelength_sampling.h"
#include "stages/final_gather.h"
#include "stages/spectral_transport.h"
#include "support/cornell_scene.h"
#include "support/render_replicates.h"
#include "support/scene_builder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <unistd.h>

using namespace sundog;
using namespace sundog::test;

namespace {

constexpr int replicates = 12;
constexpr double family_error = 0.01;

RenderRequest request(const std::string& method, std::uint64_t iterations, bool spectral, const std::map<std::string, std::string>& more = {})
{
    RenderRequest r{method, iterations, {{"sampler", "independent"}, {"max_depth", "6"}, {"spectral", spectral ? "true" : "false"}}};
    if (method != "path") r.parameters["photons"] = "4096";
    if (method == "photonmapper") r.parameters.insert_or_assign("photons", "1024");
    if (method != "path" && method != "ptracer" && method != "bdpt") r.parameters["radius"] = "0.02";
    for (const auto& [name, value] : more) r.parameters[name] = value;
    return r;
}

double channel_mean(const Image& image, int channel)
{
    double sum = 0.0;
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++) sum += static_cast<double>(image.at(x, y, channel));
    return sum / (image.width * image.height);
}

// Means of red, green and blue over the image.
std::vector<Estimate> channel_estimates(const Scene& scene, const RenderRequest& r, int seeds = replicates)
{
    std::vector<std::vector<double>> values(3);
    for (int seed = 1; seed <= seeds; seed++) {
        const Image image = render_sampled(scene, r, seed);
        for (int c = 0; c < 3; c++) values[static_cast<std::size_t>(c)].push_back(channel_mean(image, c));
    }
    std::vector<Estimate> estimates;
    for (const auto& v : values) estimates.push_back(estimate_from(v));
    return estimates;
}

// Student's test of each channel, with Bonferroni's correction. bias: relative, of density estimation; most_error: of
// differences, beyond which the test would have no power.
void expect_same_means(const std::vector<std::vector<Estimate>>& all, const std::vector<std::string>& names, double bias, double most_error = 0.05)
{
    const std::size_t channels = all.at(0).size();
    const double comparisons = static_cast<double>(all.size() * (all.size() - 1) / 2 * channels);
    const double quantile = student_quantile(replicates - 1, 0.5 * family_error / comparisons);
    for (std::size_t a = 0; a < all.size(); a++) {
        for (std::size_t b = a + 1; b < all.size(); b++) {
            for (std::size_t c = 0; c < channels; c++) {
                const Estimate &x = all[a][c], &y = all[b][c];
                const double error = std::hypot(x.standard_error, y.standard_error);
                EXPECT_NEAR(x.mean, y.mean, quantile * error + bias * std::abs(x.mean)) << names[a] << " and " << names[b] << ", channel " << c;
                EXPECT_LT(error, most_error * allowed_noise() * std::abs(x.mean)) << names[a] << " and " << names[b] << ", channel " << c;
            }
        }
    }
}

class SpectralMethods : public testing::TestWithParam<std::string> {};

// Light, one coloured surface, camera.
TEST_P(SpectralMethods, OneBounceIsThatOfRgb)
{
    const Scene scene = cornell_box(16);
    const std::map<std::string, std::string> once{{"max_depth", "2"}, {"rr_depth", "9"}};
    // ppm sees four points of a pixel, whatever its passes.
    expect_same_means(
        {channel_estimates(scene, request(GetParam(), 24, false, once)), channel_estimates(scene, request(GetParam(), 24, true, once))},
        {"rgb", "spectral"}, 0.0, GetParam() == "ppm" ? 0.1 : 0.05);
}

// Grey multiplies alike in both, however often, so that white light stays white.
TEST_P(SpectralMethods, GreyBoxIsThatOfRgbAndWhite)
{
    Scene scene = cornell_box(16);
    for (auto& bsdf : scene.bsdfs) bsdf.model = DiffuseBsdf{{0.7f, 0.7f, 0.7f}};
    const auto spectral = channel_estimates(scene, request(GetParam(), 24, true));
    expect_same_means({channel_estimates(scene, request(GetParam(), 24, false)), spectral}, {"rgb", "spectral"}, 0.0);
    // The tint of the passes' wavelengths, which all pixels share, falls with their number: 96 passes leave about 1%.
    const auto white = channel_estimates(scene, request(GetParam(), 96, true), 3);
    for (const Estimate& channel : white) EXPECT_NEAR(channel.mean, white[1].mean, 0.02 * allowed_noise() * white[1].mean);
}

TEST_P(SpectralMethods, SameSeedSameBits)
{
    const Scene scene = cornell_box(20);
    const RenderRequest r = request(GetParam(), 3, true);
    EXPECT_TRUE(render(scene, r, 5).pixels == render(scene, r, 5).pixels);
    EXPECT_FALSE(render(scene, r, 5).pixels == render(scene, r, 6).pixels);
}

// Both coats of plastic, all of the principled BSDF, phong, and a panel in relief, in a grey box whose lamp is out of sight.
Scene box_of_materials(const ColorSource& color, const ColorSource& gloss, bool nonlinear, float walls)
{
    Scene scene = cornell_box(16);
    scene.film.crop_y = 4;
    scene.film.crop_height = 48;
    for (auto& bsdf : scene.bsdfs) bsdf.model = DiffuseBsdf{{walls, walls, walls}};
    PrincipledBsdf principled;
    principled.base_color = color;
    principled.roughness = .6f;
    principled.metallic = .3f;
    principled.spec_trans = .4f;
    principled.spec_tint = .5f;
    principled.sheen = 1.0f;
    principled.sheen_tint = .5f;
    principled.clearcoat = 1.0f;
    const PlasticBsdf smooth{1.5f, 1.0f, color, gloss, nonlinear}, rough{1.5f, 1.0f, color, gloss, nonlinear, Roughness{false, .3f, .3f}};
    scene.shapes.push_back(make_sphere({-.6f, -.65f, .3f}, .3f, add_bsdf(scene, smooth)));
    scene.shapes.push_back(make_sphere({.0f, -.65f, .3f}, .3f, add_bsdf(scene, rough)));
    scene.shapes.push_back(make_sphere({.6f, -.65f, .3f}, .3f, add_bsdf(scene, principled)));
    scene.shapes.push_back(make_sphere({-.4f, .3f, -.3f}, .3f, add_bsdf(scene, PhongBsdf{color, gloss, 10.0f})));
    // Maps of normals are not colours.
    const uint panel = add_bsdf(scene, DiffuseBsdf{color});
    scene.shapes.push_back(make_quad({.1f, .0f, -.3f}, {.9f, .0f, -.3f}, {.9f, .8f, -.6f}, {.1f, .8f, -.6f},
                                     add_bsdf(scene, NormalMapBsdf{{.6f, .4f, .9f}, false, true, panel})));
    return scene;
}

TEST(Spectral, GreyMaterialsAreThoseOfRgb)
{
    const Scene scene = box_of_materials({.5f, .5f, .5f}, {.3f, .3f, .3f}, true, .6f);
    expect_same_means({channel_estimates(scene, request("path", 24, false)), channel_estimates(scene, request("path", 24, true))},
                      {"rgb", "spectral"}, 0.0);
}

// Light, a ball of one coloured material before black walls, camera: where the BSDF is linear in its colours, as all of these
// are but nonlinear plastic.
TEST(Spectral, OneBounceOnMaterialsIsThatOfRgb)
{
    const Scene all = box_of_materials({.7f, .5f, .4f}, {.2f, .25f, .3f}, false, .0f);
    const std::map<std::string, std::string> once{{"max_depth", "2"}, {"rr_depth", "9"}};
    for (const uint bsdf : {4u, 5u, 6u, 8u}) { // not the box's, nor smooth plastic, where the lamp glares
        Scene scene = all;
        scene.shapes.resize(6); // the box and its lamp
        scene.shapes.push_back(make_sphere({0, -.2f, 0}, .8f, bsdf));
        expect_same_means({channel_estimates(scene, request("path", 100, false, once)), channel_estimates(scene, request("path", 100, true, once))},
                          {"rgb", "spectral, bsdf " + std::to_string(bsdf)}, 0.0);
    }
}

// A glass ball of strong dispersion and a rough one, in a box.
Scene dispersive_box(int size)
{
    Scene scene = cornell_box(size);
    const SellmeierFormula sf11 = find_dispersion("sf11").value();
    const float index = static_cast<float>(index_at(sf11, sodium_d_line));
    DielectricBsdf glass{index, 1.0f, false, {1, 1, 1}, {1, 1, 1}};
    glass.dispersion = sf11;
    DielectricBsdf ground = glass;
    ground.roughness = Roughness{false, {0.3f}, {0.3f}};
    scene.shapes.push_back(make_sphere({.45f, -.55f, .3f}, .4f, add_bsdf(scene, glass)));
    scene.shapes.push_back(make_sphere({-.45f, -.55f, -.2f}, .4f, add_bsdf(scene, ground)));
    return scene;
}

TEST_P(SpectralMethods, ResumedIsUninterrupted)
{
    const auto file = std::filesystem::temp_directory_path() / ("sundog-spectral-" + GetParam() + "-" + std::to_string(::getpid()));
    RenderSettings settings;
    settings.method = GetParam();
    settings.parameters = request(GetParam(), 0, true).parameters;
    settings.seed = 7;
    RenderSession whole(dispersive_box(19), shared_device(), settings);
    for (int i = 0; i < 2; i++) whole.iterate();
    whole.save_checkpoint(file);
    for (int i = 0; i < 3; i++) whole.iterate();
    RenderSession resumed(dispersive_box(19), shared_device(), settings);
    resumed.resume(file);
    for (int i = 0; i < 3; i++) resumed.iterate();
    std::filesystem::remove(file);
    EXPECT_TRUE(resumed.image().pixels == whole.image().pixels);
}

INSTANTIATE_TEST_SUITE_P(Methods, SpectralMethods,
                         testing::Values("path", "ptracer", "pppm", "sppm", "cppm", "appm", "ppm", "photonmapper"),
                         [](const auto& method) { return method.param; });

// A gather ray that glass has bent asks with its hero alone, three times as strong.
TEST(Spectral, GatherRaysDisperse)
{
    Device& device = shared_device();
    const Scene description = dispersive_box(64);
    DeviceScene scene(device, description, true);
    SpectralTransport(device, scene, 3).begin_pass(0);
    const Camera camera = make_camera(description.sensor, description.film);
    CameraPaths paths(device, camera, make_pixel_filter(description.film.filter), SamplerKind::independent, scene.surface_options());
    PathPool pool(device, scene, paths.count());
    const PathRules rules{UNBOUNDED_DEPTH, 100};
    QueryTracer visible(device, scene, paths.count(), rules, false, SamplerKind::independent);
    FinalGather gather(device, scene, paths.count(), rules, SamplerKind::independent);
    const SamplerKey key = sampler_key(3, 0);
    paths.start(scene, pool, key);
    visible.trace(scene, paths, pool, key, 0.02f);
    gather.trace(scene, paths, visible, pool, key, 0.02f);
    const auto wavelengths = [](const GatherQuery& query) {
        int count = 0;
        for (int c = 0; c < 3; c++) count += component(query.throughput, c) > 0.0f;
        return query.radius > 0.0f ? count : 0;
    };
    const auto seen = visible.queries.download(), asked = gather.queries.download();
    int dispersed = 0, whole = 0;
    for (std::size_t i = 0; i < seen.size(); i++) {
        if (wavelengths(seen[i]) != 3) continue;
        dispersed += wavelengths(asked[i]) == 1;
        whole += wavelengths(asked[i]) == 3;
    }
    // The balls fill about a tenth of what the walls see.
    EXPECT_GT(dispersed, 100);
    EXPECT_GT(whole, 1000);
}

// Light tracing cannot see what is behind glass, so the others are compared. The bias is that of the edges, as in
// agreement_test.cpp: 2 r 0.21 = 0.8% for r = 0.02.
TEST(Spectral, MethodsAgreeOnDispersiveGlass)
{
    const Scene scene = dispersive_box(16);
    expect_same_means({channel_estimates(scene, request("path", 192, true)), channel_estimates(scene, request("pppm", 48, true)),
                       channel_estimates(scene, request("sppm", 48, true)), channel_estimates(scene, request("bdpt", 96, true, {{"photons", "1024"}})),
                       channel_estimates(scene, request("vcm", 96, true, {{"photons", "1024"}}))},
                      {"path", "pppm", "sppm", "bdpt", "vcm"}, 0.01);
}

// Each pass of a render: what it brought to the mean, by pixel and channel.
std::vector<Image> passes_of(const Scene& scene, const RenderRequest& r)
{
    RenderSettings settings{r.method, r.parameters, 5, {}, {}, {}};
    RenderSession session(scene, shared_device(), settings);
    std::vector<Image> passes;
    std::vector<float> sum;
    for (std::uint64_t i = 0; i < r.iterations; i++) {
        session.iterate();
        Image image = session.image();
        sum.resize(image.pixels.size());
        for (std::size_t k = 0; k < sum.size(); k++) {
            image.pixels[k] = image.pixels[k] * static_cast<float>(i + 1) - sum[k];
            sum[k] += image.pixels[k];
        }
        passes.push_back(std::move(image));
    }
    return passes;
}

// Where all is grey and nothing disperses, a pass at some wavelengths is one in RGB but for a tint: the same photons, in
// every pass the same ones.
TEST(Spectral, PhotonMapsKeepTheirPhotons)
{
    Scene scene = cornell_box(16);
    for (auto& bsdf : scene.bsdfs) bsdf.model = DiffuseBsdf{{0.7f, 0.7f, 0.7f}};
    const std::map<std::string, std::string> looked_up{
        {"final_gather", "false"}, {"direct", "photons"}, {"radius", "0.1"}, {"photons", "2000"}};
    const auto grey = passes_of(scene, request("photonmapper", 4, false, looked_up)),
               tinted = passes_of(scene, request("photonmapper", 4, true, looked_up));
    for (std::size_t pass = 0; pass < grey.size(); pass++) {
        for (int c = 0; c < 3; c++) {
            const double tint = channel_mean(tinted[pass], c) / channel_mean(grey[pass], c);
            double differing = 0.0;
            for (int y = 0; y < 16; y++)
                for (int x = 0; x < 16; x++) {
                    const double a = static_cast<double>(tinted[pass].at(x, y, c)), b = tint * static_cast<double>(grey[pass].at(x, y, c));
                    differing += std::abs(a - b) > 1e-3 * std::abs(b) + 1e-3 * std::abs(tint);
                }
            // Roulette by a probability that differs by rounding may end one path in a million elsewhere.
            EXPECT_LE(differing, 2.0) << "of 256 pixels, in pass " << pass << ", channel " << c;
        }
    }
}

// A pixel on the edge of the lamp sees the lamp in all passes, or in none.
TEST(Spectral, HitPointsStayWhereNothingDisperses)
{
    const Scene scene = cornell_box(32);
    const auto passes = passes_of(scene, request("ppm", 5, true, {{"max_depth", "1"}, {"hit_points", "1"}, {"photons", "16"}}));
    int lit = 0, edge = 0;
    const auto sees = [&](std::size_t pass, int x, int y) { return passes[pass].at(x, y, 1) > 0.0f; };
    for (int y = 0; y < 32; y++) {
        for (int x = 0; x < 32; x++) {
            for (std::size_t pass = 1; pass < passes.size(); pass++)
                ASSERT_EQ(sees(pass, x, y), sees(0, x, y)) << x << ", " << y << " in pass " << pass;
            lit += sees(0, x, y);
            if (x > 0) edge += sees(0, x, y) != sees(0, x - 1, y);
        }
    }
    // The lamp, foreshortened to hardly more than a row of pixels, is seen, and has an edge.
    EXPECT_GT(lit, 4);
    EXPECT_GT(edge, 4);
}

// A prism of flint glass with its apex up, whose faces are 0.15 m high and 1 m long. Directions are angles from +x in the plane z = 0;
// light enters along +x at the middle of the first face, the origin, at the angle of least deviation for the sodium line, and leaves at
// -41.2 degrees.
struct FlintPrism {
    SellmeierFormula flint = find_dispersion("sf11").value();
    double n = index_at(flint, sodium_d_line), apex = M_PI / 4.0, incidence = std::asin(n * std::sin(0.5 * apex));
    double deviation = 2.0 * incidence - apex;
    Vec3 outwards = along(-deviation, 1.0), across = along(M_PI / 2.0 - deviation, 1.0);

    static Vec3 along(double angle, double length)
    {
        return {static_cast<float>(length * std::cos(angle)), static_cast<float>(length * std::sin(angle)), 0};
    }

    void add_to(SceneBuilder& builder) const
    {
        DielectricBsdf glass{static_cast<float>(n), 1.0f, false, {1, 1, 1}, {1, 1, 1}};
        glass.dispersion = flint;
        const Vec3 down_entry = along(M_PI - incidence + M_PI / 2.0, 0.15), down_exit = along(M_PI - incidence + M_PI / 2.0 + apex, 0.15);
        const Vec3 top = down_entry * -0.5f - Vec3{0, 0, 0.5f}, entry = top + down_entry, exit = top + down_exit, length{0, 0, 1};
        builder.shape(TriangleMesh{.positions = {top, entry, exit, top + length, entry + length, exit + length},
                                   .normals = {},
                                   .uvs = {},
                                   .triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}},
                                   .attributes = {}},
                      builder.bsdf(glass));
    }
};

// 12 x 12 pixels; `left` is the image's left.
Scene seen_from(Scene scene, Vec3 position, Vec3 direction, Vec3 left, double half_angle)
{
    scene.file = "prism";
    scene.sensor.position = position;
    scene.sensor.axis_x = left;
    scene.sensor.axis_y = {0, 0, 1};
    scene.sensor.axis_z = direction;
    scene.sensor.fov_x = static_cast<float>(2.0 * half_angle);
    scene.film.width = scene.film.height = scene.film.crop_width = scene.film.crop_height = 12;
    scene.film.filter = {FilterKind::box, 0.5f, 0.5f, 0, 0};
    return scene;
}

// A lamp at 3 m from the prism throws its spectrum on a screen as far beyond. Unlike a projector's, its light can be found
// from the camera as well.
Scene rainbow()
{
    const FlintPrism prism;
    const Vec3 z{0, 0, 1};
    SceneBuilder builder;
    const uint white = builder.bsdf(DiffuseBsdf{{0.8f, 0.8f, 0.8f}}), black = builder.bsdf(DiffuseBsdf{{0, 0, 0}});
    prism.add_to(builder);
    builder.shape(parallelogram(prism.outwards * 3.0f - prism.across - z, z * 2.0f, prism.across * 2.0f), white);
    builder.shape(parallelogram({0, -3, -2}, z * 4.0f, {0, 2.85f, 0}), black); // keeps the lamp itself from the screen
    builder.light(parallelogram({-3, -0.2f, -0.8f}, {0, 0.4f, 0}, {0, 0, 1.6f}), {50, 50, 50});
    return seen_from(builder.scene, prism.outwards * 1.5f, prism.outwards, prism.across, std::atan(0.45 / 1.5)); // to the left: red
}

// A narrow lamp, 3 m beyond the prism, seen through it from 3 m before it: each colour elsewhere.
Scene lamp_behind_prism()
{
    const FlintPrism prism;
    SceneBuilder builder;
    prism.add_to(builder);
    const Vec3 across = prism.across, z{0, 0, 1};
    builder.light(parallelogram(prism.outwards * 3.0f - across * 0.03f - z, z * 2.0f, across * 0.06f), {1, 1, 1});
    return seen_from(builder.scene, {-3, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.02);
}

// Of red, green and blue: the mean over the image, and that of the radiance times its distance from the image's left.
std::vector<Estimate> moments_across(const Scene& scene, const RenderRequest& r)
{
    std::vector<std::vector<double>> values(6);
    for (int seed = 1; seed <= replicates; seed++) {
        const Image image = render_sampled(scene, r, seed);
        for (int c = 0; c < 3; c++) {
            double moment = 0.0;
            for (int y = 0; y < image.height; y++)
                for (int x = 0; x < image.width; x++) moment += (x + 0.5) / image.width * static_cast<double>(image.at(x, y, c));
            values[static_cast<std::size_t>(c)].push_back(channel_mean(image, c));
            values[static_cast<std::size_t>(c) + 3].push_back(moment / (image.width * image.height));
        }
    }
    std::vector<Estimate> estimates;
    for (const auto& v : values) estimates.push_back(estimate_from(v));
    return estimates;
}

// All that these hit points show comes by way of the prism, and is not from photons.
TEST(Spectral, HitPointsBehindAPrismShowEachColourElsewhere)
{
    const Scene scene = lamp_behind_prism();
    std::vector<std::vector<Estimate>> all;
    for (const char* method : {"path", "ppm"}) {
        all.push_back(moments_across(scene, request(method, 48, true,
                                                    method == std::string("ppm") ? std::map<std::string, std::string>{{"photons", "16"}}
                                                                                 : std::map<std::string, std::string>{})));
        const auto& m = all.back();
        const double red = m[3].mean / m[0].mean, green = m[4].mean / m[1].mean, blue = m[5].mean / m[2].mean;
        EXPECT_GT(std::abs(red - blue), 0.05) << method;
        EXPECT_LT((green - red) * (green - blue), 0.0) << method;
    }
    expect_same_means(all, {"path", "ppm"}, 0.0, 0.1);
}

// Not always the same third of the spectrum: then two pixels in three would be without green.
TEST(Spectral, EveryHitPointBehindAPrismSeesAllColours)
{
    const Image image = render(lamp_behind_prism(), request("ppm", 48, true, {{"photons", "16"}, {"hit_points", "1"}}), 3);
    double least_spread = 10.0; // of green along a column, relative to its mean
    for (int x = 0; x < image.width; x++) {
        std::vector<double> column;
        for (int y = 0; y < image.height; y++) column.push_back(static_cast<double>(image.at(x, y, 1)));
        const Estimate green = estimate_from(column);
        if (green.mean > 0.05) least_spread = std::min(least_spread, green.standard_error * std::sqrt(image.height) / green.mean);
    }
    EXPECT_LT(least_spread, 0.6);
}

// The same colours in the same places, from the lamp and from the camera. Blur by 0.03 of the image's width leaves both
// moments: the spectrum ends well within the image.
TEST(LongSpectral, EveryMethodThrowsTheSameRainbow)
{
    const Scene scene = rainbow();
    std::vector<std::vector<Estimate>> all;
    const std::vector<std::string> methods{"path", "ptracer", "pppm", "sppm", "appm", "cppm", "ppm", "photonmapper", "bdpt", "vcm", "bpm"};
    for (const std::string& method : methods) {
        all.push_back(moments_across(scene, method == "path" ? request(method, 512, true) : request(method, 64, true, {{"photons", "65536"}})));
        const auto& m = all.back();
        const double red = m[3].mean / m[0].mean, green = m[4].mean / m[1].mean, blue = m[5].mean / m[2].mean;
        EXPECT_LT(red + 0.02, green) << method;
        EXPECT_LT(green + 0.02, blue) << method;
    }
    expect_same_means(all, methods, 0.01, 0.1);
}

// What the stages do at a dispersive interface: the lobe at a ball, fitted to each hero, sampled until it refracts.
constexpr const char* refract_kernel = R"(
    #include "scene/bsdf.h"
    __kernel void refract_hero(SURFACE_PARAMETERS, Vec3 normal, Vec3 outgoing, __global Vec3* directions, __global Vec3* weights)
    {
        const uint hero = get_global_id(0);
        if (hero >= 3u) return;
        const SurfaceView scene = SURFACE_VIEW;
        Surface surface;
        surface.shape = 0u;
        surface.shading_normal = surface.geometric_normal = unpack(normal);
        surface.outgoing = unpack(outgoing);
        PathState path = {{1.0f, 1.0f, 1.0f}, PDF_DELTA, 1u, 0u, 1.0f, 0u};
        Scattering scattering = scattering_at(&scene, &surface, 0.5f);
        disperse(hero, &path, &scattering);
        BsdfSample sample;
        bsdf_sample(&scattering, &surface, (float4)(0.5f, 0.5f, 0.99999f, 0.5f), CARRIES_FLUX, &sample);
        separate_wavelengths(&scattering, sample.direction, &path);
        directions[hero] = pack(sample.direction);
        weights[hero] = pack(path.flags & PATH_ONE_WAVELENGTH ? sample.weight : (float3)(-1.0f));
    })";

class Prism {
public:
    explicit Prism(const SellmeierFormula& formula) : device_scene_(shared_device(), scene_of(formula), true)
    {
        kernel_ = Kernel::from_source(shared_device(), "refract_hero", "Refract", refract_kernel, device_scene_.surface_options());
    }
    void set_wavelengths(const Wavelengths& w) { device_scene_.set_wavelengths(w); }

    // Where light along `direction` goes at the glass's face of outward `normal`, for a hero; checks its weight.
    Vec3 refract(Vec3 normal, Vec3 direction, std::size_t hero) const
    {
        Buffer<Vec3> directions(shared_device(), 3, "directions"), weights(shared_device(), 3, "weights");
        kernel_(3, device_scene_.surfaces(), normal, -direction, directions, weights);
        const Vec3 weight = weights.read(hero);
        for (int k = 0; k < 3; k++) EXPECT_EQ(component(weight, k), static_cast<std::size_t>(k) == hero ? 3.0f : 0.0f);
        return directions.read(hero);
    }

private:
    static Scene scene_of(const SellmeierFormula& formula)
    {
        Scene scene = cornell_box(4);
        DielectricBsdf glass{static_cast<float>(index_at(formula, sodium_d_line)), 1.0f, false, {1, 1, 1}, {1, 1, 1}};
        glass.dispersion = formula;
        scene.shapes[0].bsdf = add_bsdf(scene, glass);
        return scene;
    }

    DeviceScene device_scene_;
    Kernel kernel_;
};

// At minimum deviation D a prism of apex angle A bends light by n sin(A / 2) = sin((A + D) / 2). Off it, here, by Snell's
// law twice: the beam falls on the first face at 50 degrees.
TEST(Spectral, PrismDeviatesEachColourByTheSellmeierIndex)
{
    constexpr double apex = 0.6, incidence = 0.87;
    for (const char* name : {"bk7", "sf11", "diamond", "water"}) {
        const SellmeierFormula formula = find_dispersion(name).value();
        Prism prism(formula);
        double last = 10.0;
        for (std::uint64_t pass = 0; pass < 4; pass++) {
            const auto wavelengths = pass_wavelengths(3, pass);
            prism.set_wavelengths(make_wavelengths(wavelengths));
            last = 10.0;
            for (std::size_t hero = 0; hero < 3; hero++) {
                const double n = index_at(formula, wavelengths[hero] * 1e-3);
                const double inside = std::asin(std::sin(incidence) / n);
                const double expected = incidence - apex + std::asin(n * std::sin(apex - inside));
                // Light along +x; the entry face's normal is turned so that it arrives under `incidence`, the exit
                // face's by pi - apex further.
                const Vec3 beam{1, 0, 0};
                const Vec3 entry{static_cast<float>(-std::cos(incidence)), static_cast<float>(std::sin(incidence)), 0};
                const double exit_angle = M_PI - incidence - (M_PI - apex);
                const Vec3 exit{static_cast<float>(std::cos(exit_angle)), static_cast<float>(std::sin(exit_angle)), 0};
                const Vec3 out = prism.refract(exit, prism.refract(entry, beam, hero), hero);
                const double deviation = std::abs(std::atan2(static_cast<double>(out.y), static_cast<double>(out.x)));
                EXPECT_NEAR(deviation, expected, 1e-5) << name << " at " << wavelengths[hero] << " nm"; // float's rounding
                EXPECT_LT(deviation, last) << "longer waves are bent less";
                last = deviation;
            }
        }
    }
}

} // namespace
