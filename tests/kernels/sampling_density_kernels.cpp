// Smoothing kernels and the estimators built on them: kernels integrate to 1 over the disk, and sums come out right.
#include "shared/photon.h"
#include "support/device_fixture.h"

#include <cmath>
#include <numbers>

namespace sundog
{
namespace
{

using std::numbers::pi;

// A photon as an estimator sees it; those not in the mask must not count, whatever they hold.
struct Weighted {
    float t_squared;
    Vec3 flux;
    bool in_mask;
};

class Estimators : public DeviceFixture
{
protected:
    GatherSum sum(const std::string& estimator, int density_kernel, float radius, std::vector<Weighted> photons)
    {
        while (photons.size() % 8 != 0) photons.push_back({NAN, {NAN, INFINITY, NAN}, false});
        const Kernel kernel = test_kernel(R"(
            __kernel void test(__global const float* values, __global const int* masks, uint count, float radius, __global GatherSum* sum)
            {
                if (get_global_id(0) != 0) return;
                Estimate estimate;
                const GatherQuery query = {{0.0f, 0.0f, 0.0f}, radius, {1.0f, 1.0f, 1.0f}, 0u, {0.0f, 0.0f, 1.0f}, 0u};
                const Offset8 unused = {(float8)(0.0f), (float8)(0.0f), (float8)(0.0f)}; // all are radially symmetric
                estimator_begin(&estimate, &query);
                for (uint i = 0u; i < count; i += 8u) {
                    __global const float* v = values + 4u * i;
                    estimator_add(&estimate, vload8(0, masks + i), unused, vload8(0, v), vload8(1, v), vload8(2, v), vload8(3, v));
                }
                *sum = estimator_end(&estimate, radius);
            })",
                                          {{{"DENSITY_KERNEL", std::to_string(density_kernel)}}, {estimator}});
        std::vector<float> values;
        std::vector<int> masks;
        for (std::size_t i = 0; i < photons.size(); i += 8)
            for (int member = 0; member < 4; ++member)
                for (std::size_t lane = 0; lane < 8; ++lane) {
                    const Weighted& p = photons[i + lane];
                    values.push_back(member == 0 ? p.t_squared : member == 1 ? p.flux.x : member == 2 ? p.flux.y : p.flux.z);
                }
        for (const Weighted& p : photons) masks.push_back(p.in_mask ? -1 : 0);
        const auto result = allocate<GatherSum>(1);
        kernel.launch_grouped(1, 1, upload(values), upload(masks), static_cast<uint>(photons.size()), radius, result);
        return result.read(0);
    }
};

constexpr int kernels = 6; // as DENSITY_KERNEL: (1 - t^2)^n up to n = 3, cone, Gaussian

// Before it is made to integrate to 1. [Jensen 1996], with c = 1.1 and beta = 1.953.
double shape(int kernel, double t_squared)
{
    if (kernel <= 3) return std::pow(1.0 - t_squared, kernel);
    if (kernel == 4) return 1.0 - std::sqrt(t_squared) / 1.1;
    return 1.0 - (1.0 - std::exp(-1.953 * t_squared / 2.0)) / (1.0 - std::exp(-1.953));
}

// Over the unit disk, by Simpson's rule in the radius.
double integral(int kernel)
{
    constexpr int steps = 2000;
    double sum = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const double t = double(i) / steps;
        sum += 2.0 * pi * t * shape(kernel, t * t) * (i == 0 || i == steps ? 1.0 : i % 2 ? 4.0 : 2.0);
    }
    return sum / (3.0 * steps);
}

double plain_kernel(int kernel, double t_squared)
{
    return shape(kernel, t_squared) / integral(kernel);
}

// The factor published with the Gaussian, 0.918, keeps 53% of the energy: what keeps all is 1.728.
TEST(GaussianFilter, PublishedFactorLosesEnergy)
{
    EXPECT_NEAR(0.918 * integral(5) / pi, 0.531, 5e-4);
    EXPECT_NEAR(pi / integral(5), 1.728, 5e-4);
}

// Photons on rings, each with the flux that unit irradiance brings its ring: the estimate is the kernel's integral.
TEST_F(Estimators, KernelsIntegrateToOneOverTheDisk)
{
    constexpr int rings = 4096;
    const float radius = 0.03f;
    std::vector<Weighted> photons;
    for (int i = 0; i < rings; ++i) {
        const float area = static_cast<float>(pi * radius * radius / rings); // rings of equal area
        photons.push_back({(static_cast<float>(i) + 0.5f) / rings, {area, 2.0f * area, 0.0f}, true});
    }
    for (int n = 0; n < kernels; ++n) {
        const GatherSum integral = sum("estimators/radiance_estimate.h", n, radius, photons);
        EXPECT_NEAR(integral.flux.x, 1.0, 1e-4) << "kernel " << n;
        EXPECT_NEAR(integral.flux.y, 2.0, 2e-4) << "kernel " << n;
        EXPECT_EQ(integral.flux.z, 0.0f);
    }
}

const std::vector<Weighted> some_photons = {
    {0.0f, {1, 2, 3}, true},      {0.25f, {4, 5, 6}, true},        {0.5f, {100, 100, 100}, false}, {0.99f, {7, 8, 9}, true},
    {0.1f, {0.5f, 0, 0}, true},   {0.3f, {0, 0.25f, 0}, true},     {2.0f, {NAN, NAN, NAN}, false}, {0.7f, {1, 1, 1}, true},
    {0.6f, {2, 0.125f, 4}, true}, {0.9f, {INFINITY, 0, 0}, false},
};

TEST_F(Estimators, RadianceIsTheSumOfKernelTimesFlux)
{
    for (int n = 0; n < kernels; ++n) {
        double red = 0.0, blue = 0.0;
        for (const Weighted& p : some_photons) {
            if (!p.in_mask) continue;
            red += plain_kernel(n, p.t_squared) * p.flux.x / 4.0;
            blue += plain_kernel(n, p.t_squared) * p.flux.z / 4.0;
        }
        const GatherSum result = sum("estimators/radiance_estimate.h", n, 2.0f, some_photons);
        EXPECT_NEAR(result.flux.x, red, 1e-5 * red) << n;
        EXPECT_NEAR(result.flux.z, blue, 1e-5 * blue) << n;
    }
}

TEST_F(Estimators, FluxSumAddsUpAndCounts)
{
    const GatherSum result = sum("estimators/flux_sum.h", 0, 2.0f, some_photons);
    EXPECT_EQ(result.count, 7.0f);
    EXPECT_FLOAT_EQ(result.flux.x, 15.5f);
    EXPECT_FLOAT_EQ(result.flux.y, 16.375f);
    EXPECT_FLOAT_EQ(result.flux.z, 23.0f);
    const GatherSum none = sum("estimators/flux_sum.h", 0, 2.0f, {{0.1f, {1, 1, 1}, false}});
    EXPECT_EQ(none.count, 0.0f);
}

} // namespace
} // namespace sundog
