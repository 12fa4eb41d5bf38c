// The radii that appm learns, against what is known of light from a point over a plane, and its stages against plain C++.
#include "shared/adaptive_radius.h"
#include "support/device_fixture.h"
#include "support/double3.h"
#include "support/photon_cloud.h"

#include <cmath>
#include <numbers>
#include <random>

namespace sundog
{
namespace
{

using std::numbers::pi;

class LearnRadii : public DeviceFixture
{
protected:
    static constexpr double first_radius = 0.3; // the Laplacian's is twice that
    static constexpr uint subpaths = 16384;     // an iteration and query
    static constexpr uint iterations = 100;

    // A query over each of so many planes, far apart, which `photon_at` lights; one iteration after the other.
    template <class PhotonAt> std::vector<AdaptivePixel> learn(uint planes, int kernel, const PhotonAt& photon_at)
    {
        const auto foot = [](uint plane) { return Vec3{0, 0, 10.0f * static_cast<float>(plane)}; };
        PhotonGather<ErrorSum> gather(device_, planes, "estimators/error_estimate.h", 0);
        const float start = static_cast<float>(first_radius * first_radius);
        const auto pixels = upload(std::vector<AdaptivePixel>(planes, {start, 0, 0, 0, 0}));
        PhotonCloud cloud(device_, {{-2, -2, -1}, {2, 2, 10.0f * static_cast<float>(planes)}}, std::size_t(planes) * subpaths);
        for (uint i = 1; i <= iterations; i++) {
            std::vector<Photon> photons;
            std::vector<GatherQuery> queries;
            const auto search = static_cast<float>(2.0 * first_radius * std::pow(i, -0.1));
            for (uint plane = 0; plane < planes; plane++) {
                for (uint k = 0; k < subpaths; k++)
                    if (const auto at = photon_at(); std::abs(at.first.x) < 2 && std::abs(at.first.y) < 2)
                        photons.push_back(make_test_photon(to_float(at.first) + foot(plane), {at.second, at.second, at.second}));
                queries.push_back(make_test_query(foot(plane), search));
            }
            cloud.build(photons, search);
            cloud.gather(gather, queries);
            const auto largest = static_cast<float>(first_radius * std::pow(i + 1.0, -1.0 / 6));
            const AdaptiveSchedule schedule{static_cast<float>(i),
                                            static_cast<float>(subpaths),
                                            static_cast<float>(0.5 / (kernel + 2)),
                                            static_cast<float>(kernel_square(kernel)),
                                            largest,
                                            0.05f * largest};
            learn_(planes, upload(queries), gather.sums, schedule, planes, pixels);
        }
        return pixels.download();
    }

    // Of (1 - t^2)^n, normalised on the disk.
    static double kernel_square(int n) { return (n + 1.0) * (n + 1.0) / (pi * (2.0 * n + 1.0)); }

    std::mt19937 random_{9};
    Kernel learn_{device_, "learn_radii", "Learn radii"};
};

// A point of intensity 1 W/sr at height 1: E = (1 + x^2)^(-3/2), Delta E = -6 at its foot, and each photon carries 4 pi W,
// so that the second moment is 4 pi E there and V_1 = R 4 pi. Over the wide disk E is less, and its Laplacian even more.
TEST_F(LearnRadii, AreOptimalUnderAPointLight)
{
    std::normal_distribution<double> normal;
    const auto photon = [&] {
        const Vec3d d(normal(random_), normal(random_), normal(random_));
        const double t = d.z < 0.0 ? -1.0 / d.z : 1e6;
        return std::pair(Vec3d(d.x * t, d.y * t, 0), static_cast<float>(4 * pi));
    };
    for (const int kernel : {0, 1}) {
        SCOPED_TRACE(kernel);
        const double bias = 0.5 * 0.5 / (kernel + 2.0) * 6.0;
        const double expected =
            std::pow(kernel_square(kernel) * 4 * pi / (6.0 * subpaths * bias * bias), 1.0 / 6) * std::pow(iterations + 1.0, -1.0 / 6);
        for (const AdaptivePixel& pixel : learn(4, kernel, photon)) {
            EXPECT_NEAR(pixel.second_moment / (4 * pi), 1.0, 0.2);
            EXPECT_NEAR(std::sqrt(pixel.radius_squared) / expected, 1.0, 0.2);
        }
    }
}

// Even light has no Laplacian. That of its noise asks for about half of the wide radius that it was estimated with, which
// by the 100th iteration lies above the schedule's for any noise.
TEST_F(LearnRadii, AreTheLargestWhereLightIsEven)
{
    std::uniform_real_distribution<double> uniform(-1.5, 1.5);
    const auto pixels = learn(8, 0, [&] { return std::pair(Vec3d(uniform(random_), uniform(random_), 0), 1.0f); });
    const double largest = first_radius * std::pow(iterations + 1.0, -1.0 / 6);
    for (const AdaptivePixel& pixel : pixels) EXPECT_NEAR(std::sqrt(pixel.radius_squared), largest, 1e-5 * largest);
}

// Any paraboloid E = a + b x^2 + c y^2 gives 2 (b + c), whatever the radius; a plane gives 0.
TEST_F(LearnRadii, LaplacianOfAParaboloidIsExact)
{
    constexpr double radius = 0.8;
    constexpr int side = 400;
    std::vector<Photon> photons;
    for (int i = 0; i < side; i++)
        for (int k = 0; k < side; k++) {
            const double x = 2.0 * (i + 0.5) / side - 1.0, y = 2.0 * (k + 0.5) / side - 1.0;
            const double irradiance = 3.0 + 0.7 * x + 1.5 * x * x - 0.4 * y * y + 2.0 * x * y, cell = 4.0 / (side * side);
            photons.push_back(
                make_test_photon(to_float(Vec3d(x, y, 0)), {static_cast<float>(irradiance * cell), static_cast<float>(cell), 0}));
        }
    PhotonCloud cloud(device_, {{-1, -1, -1}, {1, 1, 1}}, photons.size());
    cloud.build(photons, static_cast<float>(radius));
    PhotonGather<ErrorSum> gather(device_, 1, "estimators/error_estimate.h", 0);
    const ErrorSum sum = cloud.gather(gather, {make_test_query({0, 0, 0}, static_cast<float>(radius))})[0];
    // What is left is the midpoint rule's error on the disk's rim.
    EXPECT_NEAR(sum.laplacian.x, 2 * (1.5 - 0.4), 0.02);
    EXPECT_NEAR(sum.laplacian.y, 0.0, 0.005);
}

} // namespace
} // namespace sundog
