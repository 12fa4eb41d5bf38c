// Exponentials, logarithms and powers of lobes against the C++ library's in double precision.
#include "support/device_fixture.h"

#include <algorithm>
#include <cmath>

namespace sundog
{
namespace
{

class Power : public DeviceFixture
{
protected:
    // A function of x (and of exponents) at every item.
    std::vector<float> evaluate(const std::string& expression, const std::vector<float>& x, const std::vector<float>& exponents = {})
    {
        const Kernel kernel = test_kernel(R"(
            __kernel void test(__global const float* xs, __global const float* exponents, uint count, __global float* results)
            {
                const uint i = get_global_id(0);
                if (i >= count) return;
                const float x = xs[i], n = exponents[i];
                results[i] = )" + expression + R"(;
            })",
                                          {{}, {"math/power.h"}});
        const auto results = allocate<float>(x.size());
        kernel(x.size(), upload(x), upload(exponents.empty() ? x : exponents), static_cast<uint>(x.size()), results);
        return results.download();
    }
};

constexpr int count = 4096;
constexpr double rounding = 0x1p-24;

TEST_F(Power, LogarithmHasItsDigitsNearOne)
{
    std::vector<float> x = {1.0f, 1.0f - 0x1p-24f, 1.0f + 0x1p-23f, 0x1p-126f, 1e30f, 0.70710678f, 0.70710671f};
    for (int i = 1; i < count; ++i) {
        x.push_back(static_cast<float>(i) / count);
        x.push_back(static_cast<float>(std::exp2(-100.0 * i / count)));
    }
    const auto got = evaluate("fast_log(x)", x);
    for (std::size_t i = 0; i < x.size(); ++i)
        EXPECT_NEAR(got[i], std::log(static_cast<double>(x[i])), 6.0 * rounding * std::abs(std::log(static_cast<double>(x[i])))) << x[i];
    EXPECT_EQ(got[0], 0.0f);
    const float lowest = evaluate("fast_log(x)", {0.0f}).at(0);
    EXPECT_LT(lowest, -86.0f);
    EXPECT_TRUE(std::isfinite(lowest));
}

TEST_F(Power, ExponentialAndWhatItLacksOfOne)
{
    std::vector<float> x = {0.0f, -1e-30f, -0.34f, -0.3399999f, -87.0f};
    for (int i = 1; i < count; ++i) {
        x.push_back(-87.0f * static_cast<float>(i) / count);
        x.push_back(static_cast<float>(-std::exp2(-40.0 * i / count)));
    }
    const auto exponential = evaluate("fast_exp(x)", x), rest = evaluate("one_minus_exp(x)", x);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double exact = static_cast<double>(x[i]);
        EXPECT_NEAR(exponential[i], std::exp(exact), 6.0 * rounding * std::exp(exact)) << x[i];
        EXPECT_NEAR(rest[i], -std::expm1(exact), 8.0 * rounding * -std::expm1(exact)) << x[i];
    }
    for (const float y : evaluate("fast_exp(x)", {-88.0f, -1e30f, -INFINITY})) EXPECT_EQ(y, 0.0f);
}

// The error of the exponent, n times that of the logarithm, becomes a relative one of the power.
TEST_F(Power, PowersOfCosines)
{
    std::vector<float> x, n;
    for (int i = 0; i <= count; ++i)
        for (const float exponent : {0.0f, 0.5f, 1.0f, 3.0f, 40.0f, 5000.0f}) {
            x.push_back(static_cast<float>(i) / count);
            n.push_back(exponent);
        }
    const auto got = evaluate("unit_power(x, n)", x, n);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double base = static_cast<double>(x[i]), exponent = static_cast<double>(n[i]), exact = std::pow(base, exponent);
        const double log_power = base > 0.0 ? std::abs(exponent * std::log(base)) : 0.0;
        EXPECT_NEAR(got[i], exact, exact * rounding * (6.0 + 8.0 * log_power) + 1e-18) << base << "^" << exponent;
        EXPECT_LE(got[i], 1.0f);
    }
}

} // namespace
} // namespace sundog
