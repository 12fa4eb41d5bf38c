// The chi-squared radii of cppm: where photons are counted, how radii follow the tests, and what the tests decide.
#include "math/chi_squared.h"
#include "shared/binned_photons.h"
#include "support/device_fixture.h"
#include "support/double3.h"
#include "support/photon_cloud.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace sundog
{
namespace
{

using Counts = std::array<uint, DISK_BINS>;

// Counts of `photons` photons, each in the bin that `density` (any scale) says.
Counts draw(std::mt19937& random, uint photons, std::discrete_distribution<uint>& density)
{
    Counts counts{};
    for (uint i = 0; i < photons; i++) counts[density(random)]++;
    return counts;
}

double pearson(const Counts& counts, std::size_t bins)
{
    const double n = std::accumulate(counts.begin(), counts.begin() + bins, 0.0);
    double statistic = 0.0;
    for (std::size_t i = 0; i < bins; i++)
        statistic += std::pow(counts[i] - n / static_cast<double>(bins), 2) * static_cast<double>(bins) / n;
    return n > 0.0 ? statistic : 0.0;
}

class PhotonBins : public DeviceFixture
{
protected:
    static std::vector<TestThreshold> thresholds(double significance)
    {
        std::vector<TestThreshold> result;
        for (uint k = 0; k < TEST_THRESHOLDS; k++)
            result.push_back({static_cast<float>(chi_squared_quantile(significance / ((k + 1.0) * (k + 2.0)), 11)),
                              static_cast<float>(chi_squared_quantile(significance / ((k + 1.0) * (k + 2.0)), 5))});
        return result;
    }

    static TestedPixel start(float radius_squared, float first_test) { return {radius_squared, first_test, first_test, 0, {}}; }

    // One iteration of every pixel.
    void update(const Buffer<TestedPixel>& pixels, const std::vector<Counts>& found, float shrink = 0.8f)
    {
        const uint count = static_cast<uint>(found.size());
        std::vector<BinnedSum> sums(count);
        for (uint i = 0; i < count; i++) std::copy(found[i].begin(), found[i].end(), sums[i].bins);
        update_(count, upload(std::vector<GatherQuery>(count, make_test_query({0, 0, 0}, 1.0f))), upload(sums), thresholds_, count, shrink,
                1.0f, pixels, allocate<Vec3>(count));
    }

    Kernel update_{device_, "test_photon_bins", "Test"};
    Buffer<TestThreshold> thresholds_ = upload(thresholds(0.05));
};

TEST_F(PhotonBins, CountEqualAreasOfTheDisk)
{
    constexpr std::size_t count = 200'000;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const Vec3d normal = normalized(Vec3d(0.3, -0.5, 0.8));
    // Any frame will do: only how bins lie to one another matters.
    const Vec3d s = normalized(cross(normal, Vec3d(1, 0, 0))), t = cross(normal, s);
    std::vector<Photon> photons;
    while (photons.size() < count) {
        const double u = uniform(random), v = uniform(random);
        photons.push_back(make_test_photon(to_float(s * u + t * v), {1, 0, 0}, normal));
    }
    PhotonCloud cloud(device_, {{-2, -2, -2}, {2, 2, 2}}, photons.size());
    cloud.build(photons, 0.9f);
    PhotonGather<BinnedSum> gather(device_, 1, "estimators/binned_radiance.h", 0);
    const BinnedSum sum = cloud.gather(gather, {make_test_query({0, 0, 0}, 0.9f, to_float(normal))})[0];
    const double found = std::accumulate(std::begin(sum.bins), std::end(sum.bins), 0.0);
    EXPECT_NEAR(found, sum.irradiance.x * std::numbers::pi * 0.81, 1e-6 * found); // the uniform kernel
    EXPECT_NEAR(found / count, std::numbers::pi * 0.81 / 4, 5 * std::sqrt(0.64 * 0.36 / count));
    Counts counts;
    std::copy(std::begin(sum.bins), std::end(sum.bins), counts.begin());
    EXPECT_GT(chi_squared_tail(pearson(counts, DISK_BINS), DISK_BINS - 1), 1e-4);
}

// Against the same rules in double precision.
TEST_F(PhotonBins, RadiiFollowTheTests)
{
    constexpr std::size_t pixels = 300;
    constexpr float shrink = 0.8f;
    std::mt19937 random(6);
    struct Plain {
        double radius_squared = 2.0, first = 60.0, next = 60.0;
        uint tests = 0;
        Counts bins{};
    };
    std::vector<Plain> plain(pixels);
    const auto device_pixels = upload(std::vector<TestedPixel>(pixels, start(2.0f, 60.0f)));
    const auto limits = thresholds(0.05);
    int passed = 0, kept_inner = 0, shrunk = 0;
    for (int iteration = 0; iteration < 100; iteration++) {
        std::vector<Counts> found(pixels);
        for (std::size_t i = 0; i < pixels; i++) {
            // Even; brighter to one side; a bright outer ring; nothing.
            std::vector<double> density(DISK_BINS, 1.0);
            if (i % 4 == 1) std::fill(density.begin(), density.begin() + 3, 2.0);
            if (i % 4 == 2) std::fill(density.begin() + 6, density.begin() + 9, 4.0);
            std::discrete_distribution<uint> bins(density.begin(), density.end());
            found[i] = draw(random, i % 4 == 3 ? 0 : static_cast<uint>(random() % 30), bins);
            Plain& p = plain[i];
            for (std::size_t b = 0; b < DISK_BINS; b++) p.bins[b] += found[i][b];
            const double n = std::accumulate(p.bins.begin(), p.bins.end(), 0.0);
            if (n < p.next) continue;
            if (pearson(p.bins, DISK_BINS) <= static_cast<double>(limits[p.tests].disk)) {
                p.tests++;
                p.next = 2.0 * n;
                passed++;
                continue;
            }
            const bool inner_is_even = pearson(p.bins, RING_BINS) <= static_cast<double>(limits[p.tests].inner_ring);
            (inner_is_even ? kept_inner : shrunk)++;
            p = {p.radius_squared * (inner_is_even ? 0.5 : 0.8), p.first / 0.64, p.first / 0.64, 0, {}};
        }
        update(device_pixels, found, shrink);
    }
    EXPECT_GT(passed, 100);
    EXPECT_GT(kept_inner, 50);
    EXPECT_GT(shrunk, 50);
    const auto result = device_pixels.download();
    for (std::size_t i = 0; i < pixels; i++) {
        EXPECT_NEAR(result[i].radius_squared, plain[i].radius_squared, 1e-5 * plain[i].radius_squared) << i;
        EXPECT_EQ(result[i].tests, plain[i].tests) << i;
        EXPECT_TRUE(std::equal(plain[i].bins.begin(), plain[i].bins.end(), result[i].bins)) << i;
    }
}

// Of pixels with even light, at most `significance` ever shrink, however often they are tested: with a test at every
// iteration and one threshold it would be about a third.
TEST_F(PhotonBins, EvenLightKeepsItsRadius)
{
    constexpr std::size_t pixels = 4000;
    std::mt19937 random(7);
    const auto device_pixels = upload(std::vector<TestedPixel>(pixels, start(1.0f, 60.0f)));
    std::discrete_distribution<uint> even(DISK_BINS, 0.0, 1.0, [](double) { return 1.0; });
    for (int iteration = 0; iteration < 200; iteration++) {
        std::vector<Counts> found(pixels);
        for (Counts& counts : found) counts = draw(random, 20, even);
        update(device_pixels, found);
    }
    double shrunk = 0.0;
    for (const TestedPixel& pixel : device_pixels.download()) shrunk += pixel.radius_squared < 1.0f ? 1.0 : 0.0;
    // Seven tests, with 7 / 8 of the level together; they are correlated, so the share is less.
    const double error = std::sqrt(0.05 * 0.95 / pixels);
    EXPECT_LT(shrunk / pixels, 0.05 * 7 / 8 + 3 * error);
    EXPECT_GT(shrunk / pixels, 0.02);
}

// At an edge every test fails, and r^2 ~ N^(-1/3): the schedule with alpha = 2/3.
TEST_F(PhotonBins, EdgesShrinkAtTheOptimalRate)
{
    constexpr std::size_t pixels = 256;
    std::mt19937 random(8);
    const auto device_pixels = upload(std::vector<TestedPixel>(pixels, start(1.0f, 60.0f)));
    std::vector<double> half_dark(DISK_BINS, 1.0);
    for (const std::size_t bin : {3, 4, 5, 9, 10, 11}) half_dark[bin] = 0.02;
    std::discrete_distribution<uint> edge(half_dark.begin(), half_dark.end());
    double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0, points = 0;
    for (int iteration = 1; iteration <= 1500; iteration++) {
        const auto now = device_pixels.download();
        std::vector<Counts> found(pixels);
        double mean = 0.0;
        for (std::size_t i = 0; i < pixels; i++) {
            mean += now[i].radius_squared / pixels;
            found[i] = draw(random, std::poisson_distribution<uint>(30.0 * now[i].radius_squared)(random), edge);
        }
        update(device_pixels, found);
        if (iteration < 30) continue;
        // Weighted by 1 / i: every octave counts the same.
        const double x = std::log(iteration), y = std::log(mean), w = 1.0 / iteration;
        sum_x += w * x, sum_y += w * y, sum_xx += w * x * x, sum_xy += w * x * y, points += w;
    }
    const double slope = (sum_xy * points - sum_x * sum_y) / (sum_xx * points - sum_x * sum_x);
    // The steps of a factor 0.8 do not quite average out over the 5.6 octaves.
    EXPECT_NEAR(slope, -1.0 / 3, 0.03);
}

} // namespace
} // namespace sundog
