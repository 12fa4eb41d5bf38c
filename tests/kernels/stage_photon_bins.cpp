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

// Probability that a non-central chi-squared variable exceeds `statistic`: the mixture of central ones of degrees + 2 j, j by
// Poisson's law with the mean noncentrality / 2. Degrees: odd.
double noncentral_chi_squared_tail(double statistic, int degrees, double noncentrality)
{
    double sum = 0.0;
    for (int j = 0; j < 200; j++)
        sum += std::exp(-0.5 * noncentrality + j * std::log(std::max(0.5 * noncentrality, 1e-300)) - std::lgamma(j + 1.0)) *
               chi_squared_tail(statistic, degrees + 2 * j);
    return sum;
}

// Of n photons with these probabilities of `bins` bins, against equal ones.
double noncentrality(const std::vector<double>& probabilities, std::size_t bins, double n)
{
    const double all = std::accumulate(probabilities.begin(), probabilities.begin() + bins, 0.0);
    double sum = 0.0;
    for (std::size_t b = 0; b < bins; b++) sum += std::pow(probabilities[b] / all - 1.0 / static_cast<double>(bins), 2);
    return n * all * static_cast<double>(bins) * sum;
}

// Probabilities of the bins of a unit disk that is `contrast` times as bright beyond the line at `distance` from its middle.
std::vector<double> step_edge(double distance, double contrast)
{
    constexpr int lines = 800;
    std::vector<double> bins(DISK_BINS);
    for (int i = 0; i < lines * lines; i++) {
        const double x = 2.0 * (i % lines + 0.5) / lines - 1.0, y = 2.0 * (i / lines + 0.5) / lines - 1.0;
        if (x * x + y * y >= 1.0) continue;
        const auto sector = static_cast<std::size_t>((std::atan2(y, x) / std::numbers::pi + 1.0) * 3.0) % RING_BINS;
        bins[sector + (x * x + y * y < 0.5 ? 0 : RING_BINS)] += x > distance ? contrast : 1.0;
    }
    const double all = std::accumulate(bins.begin(), bins.end(), 0.0);
    for (double& bin : bins) bin /= all;
    return bins;
}

// A multinomial draw, bin by bin: as draw(), for many photons.
Counts draw_many(std::mt19937& random, uint photons, const std::vector<double>& probabilities)
{
    Counts counts{};
    double left = 1.0;
    for (std::size_t b = 0; b < DISK_BINS; b++) {
        counts[b] =
            b + 1 == DISK_BINS ? photons : std::binomial_distribution<uint>(photons, std::min(1.0, probabilities[b] / left))(random);
        photons -= counts[b];
        left -= probabilities[b];
    }
    return counts;
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

// The first test finds a step edge as often as Pearson's theory says, and where it is sure of one it keeps half the disk as
// often as the inner ring's own test passes. In so many photons the theory, which is of their limit, is good to 0.003.
TEST_F(PhotonBins, FindEdgesAsOftenAsTheNoncentralDistributionSays)
{
    constexpr std::size_t pixels = 6000;
    constexpr uint photons = 20'000;
    struct Edge {
        double distance, contrast;
    };
    std::mt19937 random(9);
    const TestThreshold limit = thresholds(0.05).front();
    double weakest = 1.0, strongest = 0.0;
    for (const Edge edge : {Edge{0.0, 1.04}, Edge{0.0, 1.06}, Edge{0.3, 1.07}, Edge{0.0, 1.09}, Edge{0.75, 1.13}, Edge{0.75, 1.45},
                            Edge{0.6, 1.25}, Edge{0.5, 1.2}}) {
        const std::vector<double> bins = step_edge(edge.distance, edge.contrast);
        const auto device_pixels = upload(std::vector<TestedPixel>(pixels, start(1.0f, static_cast<float>(photons))));
        std::vector<Counts> found(pixels);
        for (Counts& counts : found) counts = draw_many(random, photons, bins);
        update(device_pixels, found);
        double failed = 0.0, halved = 0.0;
        for (const TestedPixel& pixel : device_pixels.download()) {
            failed += pixel.radius_squared < 1.0f ? 1.0 : 0.0;
            halved += pixel.radius_squared == 0.5f ? 1.0 : 0.0;
        }
        const double power =
            noncentral_chi_squared_tail(static_cast<double>(limit.disk), DISK_BINS - 1, noncentrality(bins, DISK_BINS, photons));
        // Of eight edges, eleven numbers: one is beyond four standard errors by chance in 1400 runs.
        const auto tolerance = [](double share) { return 4.0 * std::sqrt(share * (1.0 - share) / pixels) + 0.003; };
        EXPECT_NEAR(failed / pixels, power, tolerance(power)) << edge.distance << ' ' << edge.contrast;
        weakest = std::min(weakest, power);
        strongest = std::max(strongest, power);
        if (power < 0.9999) continue;
        const double inner =
            noncentral_chi_squared_tail(static_cast<double>(limit.inner_ring), RING_BINS - 1, noncentrality(bins, RING_BINS, photons));
        EXPECT_NEAR(halved / pixels, 1.0 - inner, tolerance(inner)) << edge.distance << ' ' << edge.contrast;
    }
    EXPECT_LT(weakest, 0.3);
    EXPECT_GT(strongest, 0.9999);
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
