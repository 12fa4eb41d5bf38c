// Whether error bounds hold as often as they say, whether the estimated bias is the bias, and whether a render that stops
// at a target has met it, where the truth is known.
#include "support/cornell_scene.h"
#include "support/point_over_plane.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace sundog;
using namespace sundog::test;

namespace {

constexpr double confidence = 0.9;

std::unique_ptr<RenderSession> start(const Scene& scene, const RenderRequest& request, std::uint64_t seed)
{
    RenderSettings settings;
    settings.method = request.method;
    settings.parameters = request.parameters;
    settings.seed = seed;
    settings.errors = ErrorSettings{confidence};
    return std::make_unique<RenderSession>(scene, shared_device(), settings);
}

Image render_with_errors(const Scene& scene, const RenderRequest& request, std::uint64_t seed)
{
    const auto session = start(scene, request, seed);
    for (std::uint64_t i = 0; i < request.iterations; i++) session->iterate();
    return session->image();
}

// Red of one pixel.
struct PixelError {
    double value, bound, bias;
    double corrected() const { return value - bias; }
    double half_width() const { return bound - std::abs(bias); }
};

PixelError pixel_error(const Image& image, int x, int y)
{
    const auto channel = [&](const char* name) {
        const auto found = std::find(image.channels.begin(), image.channels.end(), name);
        return found == image.channels.end() ? -1 : static_cast<int>(found - image.channels.begin());
    };
    const int bias = channel("bias.R");
    return {image.at(x, y, 0), image.at(x, y, channel("error.R")), bias < 0 ? 0.0 : image.at(x, y, bias)};
}

// Shares of a replicate's pixels.
struct Coverage {
    std::vector<double> intervals; // whose truth is within half a width of the value less its bias
    std::vector<double> bounds; // whose error is within the bound
};

Coverage coverage(const PointOverPlane& plane, const RenderRequest& request, int seeds)
{
    const Scene scene = plane.scene();
    Coverage coverage;
    for (int seed = 1; seed <= seeds; seed++) {
        const Image image = render_with_errors(scene, request, static_cast<std::uint64_t>(seed));
        double in_interval = 0.0, in_bound = 0.0;
        for (int y = 0; y < plane.size; y++)
            for (int x = 0; x < plane.size; x++) {
                const PixelError p = pixel_error(image, x, y);
                in_interval += std::abs(p.corrected() - plane.answer(x, y)) < p.half_width() ? 1.0 : 0.0;
                in_bound += std::abs(p.value - plane.answer(x, y)) < p.bound ? 1.0 : 0.0;
            }
        coverage.intervals.push_back(in_interval / (plane.size * plane.size));
        coverage.bounds.push_back(in_bound / (plane.size * plane.size));
    }
    return coverage;
}

// Light by photons alone, from points that do not depend on those of other iterations.
RenderRequest photon_request(const std::string& method, std::uint64_t iterations)
{
    RenderRequest request{method, iterations, {{"sampler", "independent"}}};
    if (method == "path") return request;
    request.parameters["photons"] = "16384";
    request.parameters["radius"] = "0.25";
    if (method != "ppm") request.parameters["direct"] = "photons";
    return request;
}

// A disk of the last iterations holds about a hundred photons, so that means over iterations are nearly normal; they are
// wrong by up to two standard errors. Coverage of pixels that share photons varies from seed to seed, and its spread
// gives the standard error that is allowed for.
void expect_coverage(const RenderRequest& request, int seeds, double largest_error)
{
    SCOPED_TRACE(request.method);
    const Coverage shares = coverage({24, 1.5}, request, seeds);
    const Estimate interval = estimate_from(shares.intervals), bound = estimate_from(shares.bounds);
    EXPECT_LT(interval.standard_error, largest_error);
    EXPECT_GT(interval.mean, 0.85 - 3 * interval.standard_error);
    EXPECT_LT(interval.mean, 0.95 + 3 * interval.standard_error);
    EXPECT_GT(bound.mean, interval.mean - 1e-9); // the bound holds the interval
    ::testing::Test::RecordProperty(request.method + " interval", std::to_string(interval.mean) + " +- " + std::to_string(interval.standard_error));
    ::testing::Test::RecordProperty(request.method + " bound", std::to_string(bound.mean));
}

TEST(ErrorBounds, HoldAsOftenAsTheySay)
{
    for (const char* method : {"pppm", "sppm", "path"}) expect_coverage(photon_request(method, 12), 16, 0.02);
}

// The contract over 200 seeds. Slow: only with scripts/test --long.
TEST(LongErrorBounds, HoldAsOftenAsTheySayForEveryMethod)
{
    for (const char* method : {"pppm", "sppm", "ppm", "appm", "cppm", "path"}) {
        SCOPED_TRACE(method);
        const Estimate interval = estimate_from(coverage({24, 1.5}, photon_request(method, 24), 200).intervals);
        EXPECT_LT(interval.standard_error, 0.006);
        EXPECT_GT(interval.mean, 0.85);
        EXPECT_LT(interval.mean, 0.95);
    }
}

} // namespace
