// Convergence: how fast the error falls, on a scene whose answer is known in every pixel.
//
// A point light over a diffuse plane: the Laplacian of its irradiance does not vanish, so density estimation has bias as
// well as noise.

#include "support/point_over_plane.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

using namespace sundog;
using namespace sundog::test;

namespace {

const PointOverPlane plane{16, 0.5};

double squared_error(const Image& image)
{
    double sum = 0.0;
    for (int y = 0; y < plane.size; y++)
        for (int x = 0; x < plane.size; x++) sum += std::pow(image.at(x, y, 0) - plane.answer(x, y), 2);
    return sum / (plane.size * plane.size);
}

struct Slope {
    double value = 0.0;
    double standard_error = 0.0;
};

// Slope of log MSE against log iterations from `first` on, doubling `doublings` times: one fit a seed, so
// that the seeds' spread gives the error of their mean.
Slope mse_slope(const RenderRequest& request, std::uint64_t first, int doublings, int seeds)
{
    const Scene scene = plane.scene();
    std::vector<std::vector<double>> mse(static_cast<std::size_t>(seeds));
    for (int seed = 0; seed < seeds; seed++) {
        RenderSettings settings;
        settings.method = request.method;
        settings.parameters = request.parameters;
        settings.seed = static_cast<std::uint64_t>(seed) + 1;
        RenderSession session(scene, shared_device(), settings);
        for (int step = 0; step <= doublings; step++) {
            while (session.iterations_done() < first << step) session.iterate();
            mse[static_cast<std::size_t>(seed)].push_back(squared_error(session.image()));
        }
    }
    // Jackknife over seeds of the slope fitted to the mean MSE: the mean of logs would be biased.
    const auto fit = [&](int left_out) {
        std::vector<double> y(static_cast<std::size_t>(doublings) + 1, 0.0);
        for (int seed = 0; seed < seeds; seed++)
            for (std::size_t step = 0; step < y.size(); step++)
                if (seed != left_out) y[step] += mse[static_cast<std::size_t>(seed)][step];
        double mean_x = 0.5 * doublings, mean_y = 0.0, xy = 0.0, xx = 0.0;
        for (double& value : y) {
            value = std::log2(value);
            mean_y += value / static_cast<double>(y.size());
        }
        for (std::size_t step = 0; step < y.size(); step++) {
            const double dx = static_cast<double>(step) - mean_x;
            xy += dx * (y[step] - mean_y);
            xx += dx * dx;
        }
        return xy / xx;
    };
    std::vector<double> left_out;
    for (int seed = 0; seed < seeds; seed++) left_out.push_back(fit(seed));
    const Estimate spread = estimate_from(left_out);
    return {fit(-1), spread.standard_error * (seeds - 1)};
}

// Of neighbouring states that are alike the mean's error falls so only when there are many more than are alike.
TEST(LongConvergence, MarkovChainsErrorFallsAsOneOverN)
{
    const Slope slope = mse_slope({"pssmlt", 0, {{"paths", "path"}, {"seeds", "256"}}}, 128, 4, 12);
    EXPECT_LT(slope.standard_error, 0.05);
    EXPECT_NEAR(slope.value, -1.0, 3.5 * slope.standard_error);
}

TEST(Convergence, UnbiasedMethodsErrorFallsAsOneOverN)
{
    for (const RenderRequest& request :
         {RenderRequest{"path", 0, {{"sampler", "independent"}}}, RenderRequest{"ptracer", 0, {{"sampler", "independent"}, {"photons", "1024"}}},
          RenderRequest{"bdpt", 0, {{"sampler", "independent"}, {"photons", "1024"}}},
          RenderRequest{"upg", 0, {{"sampler", "independent"}, {"photons", "1024"}}}}) {
        const Slope slope = mse_slope(request, 4, 5, 16);
        EXPECT_LT(slope.standard_error, 0.05) << request.method;
        EXPECT_NEAR(slope.value, -1.0, 3.5 * slope.standard_error) << request.method;
    }
}

// Where next-event estimation finds all light, merging has a weight of the order of r^2, so that its variance goes as r^2, and its bias
// as r^4: with r^2 falling as i^-(1 - alpha) the error falls as 1 / N or faster, by at most N^-(1 - alpha).
TEST(Convergence, VcmErrorFallsAtLeastAsOneOverN)
{
    const Slope slope = mse_slope({"vcm", 0, {{"sampler", "independent"}, {"photons", "1024"}, {"radius", "0.05"}, {"alpha", "0.75"}}}, 4, 5, 16);
    EXPECT_LT(slope.standard_error, 0.05);
    EXPECT_LT(slope.value, -1.0 + 3.5 * slope.standard_error);
    EXPECT_GT(slope.value, -1.25 - 3.5 * slope.standard_error);
}

TEST(Convergence, PppmErrorFallsAsNToTheMinusTwoThirds)
{
    // [Kaplanyan and Dachsbacher 2013]: at alpha = 2/3 squared bias and variance both fall as N^(-2/3). The
    // radius is large enough for bias to be a visible part of the error.
    const Slope slope = mse_slope(
        {"pppm", 0, {{"sampler", "independent"}, {"photons", "2048"}, {"radius", "0.25"}, {"direct", "photons"}, {"alpha", "0.66666667"}}}, 32, 5, 16);
    EXPECT_LT(slope.standard_error, 0.05);
    // Averages over a schedule reach their asymptote slowly: sum_{i<=n} i^(-1/3) = 1.5 n^(2/3) - 0.97 + ...
    // steepens or flattens the slope between 32 and 1024 iterations by less than 0.02.
    EXPECT_NEAR(slope.value, -2.0 / 3.0, 3.5 * slope.standard_error + 0.02);
}

TEST(Convergence, FixedRadiusKeepsItsBias)
{
    const Slope slope = mse_slope({"pppm", 0, {{"sampler", "independent"}, {"photons", "16384"}, {"radius", "0.5"}, {"direct", "photons"}, {"alpha", "1"}}}, 16, 4, 4);
    EXPECT_GT(slope.value, -0.2);
}

// Slow: only with scripts/test --long. Light by merging alone: as pppm.
TEST(LongConvergence, BpmErrorFallsAsNToTheMinusTwoThirds)
{
    const Slope slope = mse_slope({"bpm", 0, {{"sampler", "independent"}, {"photons", "2048"}, {"radius", "0.25"}, {"alpha", "0.66666667"}}}, 32, 5, 16);
    EXPECT_LT(slope.standard_error, 0.05);
    EXPECT_NEAR(slope.value, -2.0 / 3.0, 3.5 * slope.standard_error + 0.02);
}

TEST(LongConvergence, PppmKeepsItsRateOverEightDoublings)
{
    const Slope slope = mse_slope(
        {"pppm", 0, {{"sampler", "independent"}, {"photons", "2048"}, {"radius", "0.25"}, {"direct", "photons"}, {"alpha", "0.66666667"}}}, 32, 8, 12);
    EXPECT_LT(slope.standard_error, 0.03);
    EXPECT_NEAR(slope.value, -2.0 / 3.0, 3.5 * slope.standard_error + 0.01); // the schedule's own curvature, see above
}

} // namespace
