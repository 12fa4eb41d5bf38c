// Every method on every analytic scene: the image's mean against the answer that the scene file derives.

#include "support/places.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

using namespace sundog;
using namespace sundog::test;

namespace {

constexpr int replicates = 10;
constexpr int tests_in_file = 106; // bounds the family for the Bonferroni correction below

// The number after "answer:" in the scene's comment.
double answer_of(const std::string& scene)
{
    std::ifstream file(source_folder() / "scenes/analytic" / (scene + ".xml"));
    std::stringstream text;
    text << file.rdbuf();
    const auto at = text.str().find("\nanswer:");
    if (at == std::string::npos) throw std::runtime_error(scene + ".xml states no answer");
    return std::stod(text.str().substr(at + 8));
}

struct Case {
    std::string scene;
    std::string method;
    std::map<std::string, std::string> parameters;
    double relative_bias = 0.0; // of density estimation, derived below
};

void PrintTo(const Case& c, std::ostream* out)
{
    *out << c.scene << " by " << c.method;
}

std::string name_of(const testing::TestParamInfo<Case>& info)
{
    std::string name = info.param.scene + "_" + info.param.method;
    for (const auto& [key, value] : info.param.parameters)
        if (key == "direct" || key == "kernel" || key == "radius_policy" || key == "sampler" || key == "lookup" || key == "connections" || key == "paths") name += "_" + value;
        else if (key == "final_gather") name += "_final_gather_" + value;
    for (char& c : name)
        if (c == '-') c = '_';
    return name;
}

class AnalyticScenes : public testing::TestWithParam<Case> {};

TEST_P(AnalyticScenes, MeanIsTheAnswer)
{
    const Case& c = GetParam();
    // With 16 iterations vcm's standard error would be at the limit.
    RenderRequest request{c.method, c.method == "vcm" ? 32u : 16u, c.parameters};
    if (c.method == "pssmlt")
        request.parameters.insert({{"seeds", "8192"}, {"chains", "4096"}});
    else
        request.parameters.emplace("sampler", "independent");
    if (c.method != "path" && c.method != "pssmlt") request.parameters.emplace("photons", "8192");
    const Estimate estimate = estimate_image_mean(load_test_scene("analytic/" + c.scene + ".xml"), request, replicates);
    const double answer = answer_of(c.scene);
    // Two-sided, 1% for the whole file. Float rounding of the answer and of sums: 2e-5.
    const double quantile = student_quantile(replicates - 1, 0.005 / tests_in_file);
    EXPECT_NEAR(estimate.mean, answer, quantile * estimate.standard_error + (c.relative_bias + 2e-5) * answer);
    EXPECT_LT(estimate.standard_error, 0.01 * allowed_noise() * answer) << "too noisy to prove anything";
}

// Relative bias of a radius-r estimate where the irradiance has a Laplacian: 1/2 mu r^2 (Laplacian / value), with
// mu = 1/4, 1/6, 1/8, 1/10 for the kernels in order of smoothness, and the first iteration's radius as a bound. Over
// a point at height h the ratio is -6 / h^2 at the foot.
double blur(double radius, double second_moment, double height)
{
    return 0.5 * second_moment * radius * radius * 6.0 / (height * height);
}

INSTANTIATE_TEST_SUITE_P(
    Unbiased, AnalyticScenes,
    testing::Values(Case{"furnace", "path", {}}, Case{"furnace", "ptracer", {}}, Case{"sphere-furnace", "path", {}}, Case{"sphere-furnace", "ptracer", {}},
                    Case{"parallel-light", "path", {}}, Case{"parallel-light", "ptracer", {{"photons", "65536"}}}, Case{"point-over-plane", "path", {}},
                    Case{"point-over-plane", "ptracer", {{"photons", "65536"}}}, Case{"sphere-light", "path", {}},
                    Case{"sphere-light", "ptracer", {{"photons", "131072"}}}, Case{"glass-in-white", "path", {}}, Case{"furnace", "path", {{"sampler", "sobol"}}},
                    Case{"orthographic-plane", "path", {}}, Case{"orthographic-plane", "ptracer", {{"photons", "65536"}}},
                    Case{"furnace", "ptracer", {{"sampler", "sobol"}}}, Case{"collimated-beam", "ptracer", {}}),
    name_of);

// In the furnace and under parallel light the irradiance is the same everywhere: away from edges there is no bias.
INSTANTIATE_TEST_SUITE_P(
    PhotonMapping, AnalyticScenes,
    testing::Values(Case{"furnace", "pppm", {{"radius", "0.1"}}}, Case{"furnace", "sppm", {{"radius", "0.1"}}},
                    Case{"furnace", "pppm", {{"radius", "0.1"}, {"direct", "photons"}}}, Case{"furnace", "sppm", {{"radius", "0.1"}, {"direct", "photons"}}},
                    // Photons on a sphere of radius 2, found within a ball of 0.1: the cap's area is that of the disk,
                    // up to rounding; kernels that are not uniform see distances shorter by (r / 2R)^2 / 3 < 3e-4.
                    Case{"sphere-furnace", "pppm", {{"radius", "0.1"}, {"direct", "photons"}}, 3e-4},
                    Case{"sphere-furnace", "sppm", {{"radius", "0.1"}, {"direct", "photons"}}},
                    Case{"parallel-light", "pppm", {{"radius", "0.2"}, {"direct", "photons"}, {"photons", "32768"}}},
                    Case{"parallel-light", "sppm", {{"radius", "0.2"}, {"direct", "photons"}, {"photons", "32768"}}}, Case{"parallel-light", "pppm", {}},
                    Case{"parallel-light", "sppm", {}}, Case{"point-over-plane", "pppm", {}}, Case{"point-over-plane", "sppm", {}},
                    Case{"collimated-beam", "pppm", {{"radius", "0.05"}, {"direct", "photons"}}}, Case{"collimated-beam", "pppm", {{"radius", "0.05"}}},
                    Case{"sphere-light", "pppm", {}}, Case{"sphere-light", "sppm", {}}, Case{"glass-in-white", "pppm", {}}, Case{"glass-in-white", "sppm", {}},
                    Case{"orthographic-plane", "pppm", {}}, Case{"orthographic-plane", "sppm", {}}, Case{"glass-in-white", "cppm", {}}, Case{"glass-in-white", "appm", {}},
                    Case{"furnace", "appm", {{"radius", "0.1"}, {"direct", "photons"}}}, Case{"glass-in-white", "ppm", {}},
                    Case{"furnace", "ppm", {{"radius", "0.1"}}}, Case{"parallel-light", "ppm", {{"radius", "0.2"}, {"photons", "32768"}}},
                    Case{"furnace", "cppm", {{"radius", "0.1"}, {"direct", "photons"}}},
                    Case{"parallel-light", "cppm", {{"radius", "0.2"}, {"direct", "photons"}, {"photons", "32768"}}}),
    name_of);

// Where nothing is merged there is no blur; where all is, what is derived above.
INSTANTIATE_TEST_SUITE_P(
    Bidirectional, AnalyticScenes,
    testing::Values(Case{"furnace", "bdpt", {}}, Case{"furnace", "bdpt", {{"connections", "resampled"}, {"picks", "3"}}}, Case{"sphere-furnace", "bdpt", {}},
                    Case{"parallel-light", "bdpt", {}}, Case{"point-over-plane", "bdpt", {}}, Case{"sphere-light", "bdpt", {}},
                    Case{"glass-in-white", "bdpt", {}}, Case{"orthographic-plane", "bdpt", {}}, Case{"collimated-beam", "bdpt", {}},
                    Case{"furnace", "vcm", {{"radius", "0.02"}}}, Case{"sphere-furnace", "vcm", {{"radius", "0.1"}}},
                    Case{"parallel-light", "vcm", {{"radius", "0.2"}}}, Case{"point-over-plane", "vcm", {{"radius", "0.05"}}, blur(0.05, 1.0 / 4, 1)},
                    Case{"sphere-light", "vcm", {{"radius", "0.05"}, {"photons", "65536"}}, blur(0.05, 1.0 / 4, 2)}, Case{"glass-in-white", "vcm", {}},
                    Case{"orthographic-plane", "vcm", {}}, Case{"collimated-beam", "vcm", {{"radius", "0.05"}}},
                    Case{"furnace", "bpm", {{"radius", "0.02"}}, 2 * 0.02 * 0.21}, Case{"sphere-furnace", "bpm", {{"radius", "0.1"}}},
                    Case{"parallel-light", "bpm", {{"radius", "0.2"}, {"photons", "32768"}}}, Case{"glass-in-white", "bpm", {}},
                    Case{"point-over-plane", "bpm", {{"radius", "0.05"}, {"photons", "65536"}}, blur(0.05, 1.0 / 4, 1)},
                    Case{"sphere-light", "bpm", {{"radius", "0.08"}, {"photons", "65536"}}, blur(0.08, 1.0 / 4, 2)},
                    Case{"orthographic-plane", "bpm", {}},
                    Case{"furnace", "upg", {{"radius", "0.02"}}}, Case{"sphere-furnace", "upg", {{"radius", "0.03"}}},
                    Case{"sphere-light", "upg", {}}, Case{"point-over-plane", "upg", {}}, Case{"glass-in-white", "upg", {}},
                    Case{"collimated-beam", "upg", {}}),
    name_of);

// Chains' states lie on the same paths.
INSTANTIATE_TEST_SUITE_P(Metropolis, AnalyticScenes,
                         testing::Values(Case{"furnace", "pssmlt", {}}, Case{"sphere-light", "pssmlt", {}}, Case{"glass-in-white", "pssmlt", {{"paths", "path"}}}), name_of);
INSTANTIATE_TEST_SUITE_P(LongMetropolis, AnalyticScenes,
                         testing::Values(Case{"furnace", "pssmlt", {{"paths", "path"}}}, Case{"sphere-furnace", "pssmlt", {}}, Case{"parallel-light", "pssmlt", {}},
                                         Case{"point-over-plane", "pssmlt", {{"paths", "path"}}}, Case{"glass-in-white", "pssmlt", {}},
                                         Case{"orthographic-plane", "pssmlt", {}}, Case{"collimated-beam", "pssmlt", {}}),
                         name_of);

// No vertex is regularized in them, or none should be.
INSTANTIATE_TEST_SUITE_P(Regularized, AnalyticScenes,
                         testing::Values(Case{"glass-in-white", "psr", {{"angle", "20"}, {"paths", "bdpt"}}}), name_of);

// The map is traced once for all iterations; light straight from its source is in the caustic map if it is in any.
INSTANTIATE_TEST_SUITE_P(
    FixedMaps, AnalyticScenes,
    testing::Values(
        // Gather rays find light once reflected, a quarter of all, dimmed along the edges as agreement_test.cpp derives.
        Case{"furnace", "photonmapper", {{"radius", "0.02"}}, 0.25 * 2 * 0.02 * 0.21},
        Case{"sphere-furnace", "photonmapper", {{"radius", "0.1"}}, 3e-4},
        Case{"sphere-furnace", "photonmapper", {{"radius", "0.1"}, {"final_gather", "false"}, {"photons", "65536"}}, 3e-4},
        Case{"parallel-light", "photonmapper", {}}, Case{"point-over-plane", "photonmapper", {}}, Case{"sphere-light", "photonmapper", {}},
        Case{"glass-in-white", "photonmapper", {}}, Case{"collimated-beam", "photonmapper", {{"caustic_radius", "0.05"}}},
        Case{"parallel-light", "photonmapper", {{"caustic_radius", "0.2"}, {"direct", "photons"}, {"caustic_photons", "400000"}}},
        // The mean of 1 / area, and so of the sum over the k - 1 nearest.
        Case{"parallel-light", "photonmapper", {{"lookup", "nearest"}, {"nearest", "20"}, {"direct", "photons"}, {"caustic_photons", "800000"}}}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    BlurredLight, AnalyticScenes,
    testing::Values(
        Case{"point-over-plane", "pppm", {{"radius", "0.05"}, {"direct", "photons"}, {"kernel", "uniform"}, {"photons", "65536"}}, blur(0.05, 1.0 / 4, 1)},
        Case{"point-over-plane", "pppm", {{"radius", "0.05"}, {"direct", "photons"}, {"kernel", "epanechnikov"}, {"photons", "65536"}}, blur(0.05, 1.0 / 6, 1)},
        Case{"point-over-plane", "pppm", {{"radius", "0.05"}, {"direct", "photons"}, {"kernel", "biweight"}, {"photons", "65536"}}, blur(0.05, 1.0 / 8, 1)},
        Case{"point-over-plane", "pppm", {{"radius", "0.05"}, {"direct", "photons"}, {"kernel", "triweight"}, {"photons", "65536"}}, blur(0.05, 1.0 / 10, 1)},
        Case{"point-over-plane", "sppm", {{"radius", "0.05"}, {"direct", "photons"}, {"photons", "65536"}}, blur(0.05, 1.0 / 4, 1)},
        Case{"point-over-plane", "ppm", {{"radius", "0.05"}, {"photons", "65536"}}, blur(0.05, 1.0 / 4, 1)},
        Case{"point-over-plane", "appm", {{"radius", "0.05"}, {"direct", "photons"}, {"photons", "65536"}}, blur(0.05, 1.0 / 6, 1)},
        Case{"point-over-plane", "cppm", {{"radius", "0.05"}, {"direct", "photons"}, {"photons", "65536"}}, blur(0.05, 1.0 / 4, 1)},
        Case{"sphere-light", "pppm", {{"radius", "0.08"}, {"direct", "photons"}, {"photons", "65536"}}, blur(0.08, 1.0 / 6, 2)},
        Case{"sphere-light", "sppm", {{"radius", "0.08"}, {"direct", "photons"}, {"photons", "65536"}}, blur(0.08, 1.0 / 4, 2)},
        Case{"point-over-plane", "photonmapper", {{"caustic_radius", "0.05"}, {"direct", "photons"}, {"kernel", "cone"}, {"caustic_photons", "1e6"}}, blur(0.05, 0.1731, 1)},
        Case{"point-over-plane", "photonmapper", {{"caustic_radius", "0.05"}, {"direct", "photons"}, {"kernel", "gaussian"}, {"caustic_photons", "1e6"}}, blur(0.05, 0.1985, 1)}),
    name_of);

// Every radius policy with a kernel that no method has by default.
INSTANTIATE_TEST_SUITE_P(
    RadiusPolicies, AnalyticScenes,
    testing::Values(Case{"furnace", "pppm", {{"radius", "0.1"}, {"radius_policy", "fixed"}, {"kernel", "biweight"}}},
                    Case{"furnace", "pppm", {{"radius", "0.1"}, {"radius_policy", "local"}, {"kernel", "triweight"}}},
                    Case{"furnace", "cppm", {{"radius", "0.1"}, {"radius_policy", "adaptive"}, {"kernel", "uniform"}}},
                    Case{"furnace", "sppm", {{"radius", "0.1"}, {"radius_policy", "chi_squared"}, {"kernel", "epanechnikov"}}},
                    Case{"furnace", "appm", {{"radius", "0.1"}, {"radius_policy", "schedule"}, {"kernel", "triweight"}}}),
    name_of);

// A bound on the path's edges cuts the furnace's series: L_e (1 - rho^D) / (1 - rho).
TEST(FurnaceSeries, DepthBoundCutsTheSeriesTheSameWayForEveryMethod)
{
    for (const char* method : {"path", "ptracer", "pppm", "sppm"}) {
        for (int depth : {0, 1, 2, 3, 5}) {
            RenderRequest request{method, 16, {{"max_depth", std::to_string(depth)}, {"sampler", "independent"}}};
            if (request.method != "path") request.parameters["photons"] = "8192";
            if (request.method == "pppm" || request.method == "sppm") request.parameters["radius"] = "0.1";
            const Estimate estimate = estimate_image_mean(load_test_scene("analytic/furnace.xml"), request, replicates);
            const double answer = 2.0 * (1.0 - std::pow(0.5, depth));
            EXPECT_NEAR(estimate.mean, answer, student_quantile(replicates - 1, 0.005 / 20) * estimate.standard_error + 2e-5) << method << ", depth " << depth;
        }
    }
}

// The first-hit channels say what the camera sees.
TEST(FirstHits, AlbedoNormalAndDepth)
{
    const Image image = render(load_test_scene("analytic/furnace.xml"), {"path", 4, {}}, 1);
    ASSERT_EQ(image.channels.size(), 13u);
    const int x = image.width / 2, y = image.height / 2;
    EXPECT_NEAR(image.at(x, y, 6), 0.5, 1e-5);
    EXPECT_NEAR(image.at(x, y, 11), 1.0, 1e-5); // the wall at z = -1 faces the camera
    EXPECT_NEAR(image.at(x, y, 12), 1.0, 5e-3); // from the camera, not from its near plane
}

// Seen orthographically the plane is as far everywhere, and its radiance is that of the formula in the scene file
// (direct light: all samples of a pixel agree but for its extent).
TEST(Orthographic, PixelsSeeThePlaneBelowThem)
{
    const Image image = render(load_test_scene("analytic/orthographic-plane.xml"), {"path", 16, {}}, 1);
    for (int y = 0; y < image.height; y++) {
        for (int x = 0; x < image.width; x++) {
            ASSERT_NEAR(image.at(x, y, 12), 3.0, 1e-5) << x << ", " << y;
            // The logarithm's slope is 3 r / (r^2 + 1) <= 1.5; over a pixel of side 1/8 that is a standard deviation of at
            // most 1.5 / 8 / sqrt(12) = 5.4% for a sample, 1.4% for 16 (less, for they are stratified), and no bias above
            // 0.2%.
            const double px = (x + 0.5) / 8 - 2, py = (y + 0.5) / 8 - 1;
            const double expected = 5 / M_PI * std::pow(px * px + py * py + 1, -1.5);
            ASSERT_NEAR(image.at(x, y, 0), expected, 0.05 * expected) << x << ", " << y;
        }
    }
}

} // namespace
