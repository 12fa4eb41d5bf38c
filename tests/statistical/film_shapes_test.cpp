// What methods choose by themselves (radii, photons, chains, seeds) on films of any shape: a pixel, a few, a long strip. In a spherical
// furnace each of them has the same mean.
#include "base/interrupt.h"
#include "methods/method.h"
#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace sundog;
using namespace sundog::test;

namespace
{

constexpr float albedo = 0.6f;
constexpr int longest_path = 6; // edges

// L = L_e (1 - rho^D) / (1 - rho), as in scenes/analytic/furnace.xml.
double answer()
{
    return (1.0 - std::pow(double(albedo), longest_path)) / (1.0 - double(albedo));
}

// A hollow ball that emits radiance 1, seen from its middle.
Scene spherical_furnace(int width, int height)
{
    Scene scene;
    scene.file = "spherical furnace";
    ShapeDescription ball;
    ball.geometry = Sphere{{0, 0, 0}, 1.0f, true};
    ball.bsdf = add_bsdf(scene, DiffuseBsdf{{albedo, albedo, albedo}});
    ball.emitter = AreaEmitter{{1, 1, 1}};
    scene.shapes.push_back(ball);
    scene.sensor.position = {0, 0, 0};
    scene.sensor.axis_x = {-1, 0, 0};
    scene.sensor.axis_y = {0, 1, 0};
    scene.sensor.axis_z = {0, 0, -1};
    scene.sensor.fov_x = 0.68f;
    scene.film.width = scene.film.crop_width = width;
    scene.film.height = scene.film.crop_height = height;
    scene.film.filter = {FilterKind::box, 0.5f, 0.5f, 0, 0};
    return scene;
}

struct FilmShape {
    int width, height;
    std::uint64_t iterations;
    int replicates;
};

void expect_the_furnace(const std::string& method, const FilmShape& shape, std::map<std::string, std::string> parameters = {})
{
    SCOPED_TRACE(method + " at " + std::to_string(shape.width) + "x" + std::to_string(shape.height));
    parameters.emplace("max_depth", std::to_string(longest_path));
    const Estimate estimate =
        estimate_image_mean(spherical_furnace(shape.width, shape.height), {method, shape.iterations, parameters}, shape.replicates);
    // Two-sided, 1% for all methods and shapes together. Kernels that are not uniform see chords for arcs, shorter by (r / 2R)^2 / 3 < 4%
    // in the widest automatic disk; half of that is what they add.
    const double quantile = student_quantile(shape.replicates - 1, 0.005 / 64);
    EXPECT_NEAR(estimate.mean, answer(), quantile * estimate.standard_error + 0.02 * answer());
    EXPECT_LT(estimate.standard_error, 0.1 * answer()) << "too noisy to prove anything";
}

class FilmShapes : public testing::TestWithParam<std::string>
{
};

std::vector<std::string> names_of_methods()
{
    std::vector<std::string> names;
    for (const MethodInfo* info : all_methods()) names.push_back(info->name);
    return names;
}

TEST_P(FilmShapes, OnePixelHasTheMean)
{
    expect_the_furnace(GetParam(), {1, 1, 256, 8});
}

TEST_P(FilmShapes, FewPixelsHaveTheMean)
{
    expect_the_furnace(GetParam(), {16, 16, 2, 8});
}

class LongFilmShapes : public FilmShapes
{
};

TEST_P(LongFilmShapes, AStripHasTheMean)
{
    expect_the_furnace(GetParam(), {4096, 16, 1, 5});
}

INSTANTIATE_TEST_SUITE_P(Methods, LongFilmShapes, testing::ValuesIn(names_of_methods()), [](const auto& test) { return test.param; });
INSTANTIATE_TEST_SUITE_P(Methods, FilmShapes, testing::ValuesIn(names_of_methods()), [](const auto& test) { return test.param; });

// As few photons as a user may ask for, too: what they lack is sharpness.
TEST(PhotonMapsOfFewPhotons, KeepTheirLight)
{
    expect_the_furnace("photonmapper", {16, 16, 4, 10}, {{"photons", "200"}, {"caustic_photons", "200"}});
    expect_the_furnace("photonmapper", {16, 16, 4, 10}, {{"final_gather", "false"}});
    expect_the_furnace("photonmapper", {16, 16, 4, 10}, {{"lookup", "nearest"}, {"photons", "1000"}});
}

// A pass that has no room for what its paths leave runs again, and its rays count once. The first of these iterations finds more
// photons, splats or vertices than there is room for.
TEST(RaysOfAPassThatRunsAgain, CountOnce)
{
    for (const char* method : {"sppm", "ptracer", "vcm"}) {
        RenderSettings settings;
        settings.method = method;
        settings.seed = 5;
        settings.parameters = {{"max_depth", "20"}, {"rr_depth", "20"}};
        RenderSession session(spherical_furnace(32, 32), shared_device(), settings);
        session.iterate();
        const double first = double(session.statistics().counters.rays);
        session.iterate();
        session.iterate();
        const double later = 0.5 * (double(session.statistics().counters.rays) - first);
        EXPECT_NEAR(first, later, 0.05 * later) << method;
        EXPECT_GT(later, 10 * 1024) << method << ": too short paths to fill what there is";
    }
}

// On so small a film iterations are cheap, and so are the samples that chains start from.
TEST(ChainsOfSmallFilms, StartSoon)
{
    RenderSettings settings;
    settings.method = "pssmlt";
    settings.parameters = {{"max_depth", "3"}};
    RenderSession session(spherical_furnace(1, 1), shared_device(), settings);
    session.iterate();
    EXPECT_LE(session.statistics().counters.camera_subpaths, 20'000u);
}

// Between batches of seeds a render may be stopped; it goes on later as if nothing had happened.
TEST(ChainsThatAreStopped, StartAgain)
{
    int asked = 0;
    bool stops = true;
    RenderSettings settings;
    settings.method = "pssmlt";
    settings.seed = 3;
    settings.parameters = {{"max_depth", "3"}};
    const Scene scene = spherical_furnace(4, 4);
    RenderSession undisturbed(scene, shared_device(), settings);
    undisturbed.iterate();
    settings.stop_requested = [&] { return ++asked > 3 && stops; };
    RenderSession stopped(scene, shared_device(), settings);
    EXPECT_THROW(stopped.iterate(), Interrupted);
    EXPECT_EQ(asked, 4);
    EXPECT_EQ(stopped.iterations_done(), 0u);
    stops = false;
    stopped.iterate();
    EXPECT_EQ(stopped.image().pixels, undisturbed.image().pixels);
    EXPECT_EQ(stopped.statistics().counters.rays, undisturbed.statistics().counters.rays);
}

} // namespace
