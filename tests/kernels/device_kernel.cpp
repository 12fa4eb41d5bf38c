// Launching kernels: argument checks, structs by value, group sizes, sources and build errors, profile.
#include "base/errors.h"
#include "device/kernel.h"
#include "device/profile.h"
#include "shared/light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace sundog
{
namespace
{

using testing::HasSubstr;

// A parameter block such as a method passes: larger than any scalar, with arrays inside.
struct ParameterBlock {
    float weights[50];
    int offset;
    Vec3 tint;
};

constexpr std::string_view block_source = R"(
#include "shared/light.h"
typedef struct ParameterBlock { float weights[50]; int offset; Vec3 tint; } ParameterBlock;
__kernel void weigh(const __global uint* restrict input, __global float* output, ParameterBlock block, const uint count, const ulong scale)
{
    uint i = get_global_id(0);
    if (i >= count) return;
    output[i] = block.weights[input[i] % 50u] * block.tint.y + (float)block.offset + (float)(scale >> 32);
}
)";

class DeviceKernel : public testing::Test
{
protected:
    Device device_{select_device("")};
};

TEST_F(DeviceKernel, TakesBuffersScalarsAndStructsByValue)
{
    const std::size_t count = 1000; // not a multiple of the group size
    std::vector<uint> input(count);
    std::iota(input.begin(), input.end(), 7u);
    ParameterBlock block{};
    for (int i = 0; i < 50; ++i) block.weights[i] = 0.5f * float(i);
    block.offset = -3;
    block.tint = {1.0f, 4.0f, 9.0f};

    const Kernel weigh = Kernel::from_source(device_, "weigh", "Weigh", block_source);
    const Buffer<uint> numbers(device_, input, "input");
    const Buffer<float> weighed(device_, count, "output");
    weigh(count, numbers, weighed, block, uint(count), ulong(5) << 32);

    const auto output = weighed.download();
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(output[i], block.weights[input[i] % 50] * 4.0f - 3.0f + 5.0f) << i;
}

std::string message_of(const auto& action)
{
    try {
        action();
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "no std::logic_error";
}

TEST_F(DeviceKernel, RefusesWrongArgumentTypesByName)
{
    const Kernel weigh = Kernel::from_source(device_, "weigh", "Weigh", block_source);
    const Buffer<uint> numbers(device_, 8, "input");
    const Buffer<float> weighed(device_, 8, "output");
    const ParameterBlock block{};
    const auto wrong_buffer = message_of([&] { weigh(8, weighed, weighed, block, 8u, ulong(1)); });
    EXPECT_THAT(wrong_buffer, testing::AllOf(HasSubstr("weigh"), HasSubstr("input"), HasSubstr("uint*"), HasSubstr("float*")));
    const auto wrong_struct = message_of([&] { weigh(8, numbers, weighed, Light{}, 8u, ulong(1)); });
    EXPECT_THAT(wrong_struct, testing::AllOf(HasSubstr("block"), HasSubstr("ParameterBlock"), HasSubstr("Light")));
    const auto wrong_scalar = message_of([&] { weigh(8, numbers, weighed, block, 8, ulong(1)); });
    EXPECT_THAT(wrong_scalar, testing::AllOf(HasSubstr("count"), HasSubstr("uint"), HasSubstr("int")));
    const auto too_few = message_of([&] { weigh(8, numbers, weighed, block, 8u); });
    EXPECT_THAT(too_few, testing::AllOf(HasSubstr("5 arguments"), HasSubstr("given 4")));
    const auto too_many = message_of([&] { weigh(8, numbers, weighed, block, 8u, ulong(1), 1.0f); });
    EXPECT_THAT(too_many, HasSubstr("5 arguments"));
}

} // namespace
} // namespace sundog
