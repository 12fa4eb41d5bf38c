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

struct NumberedBuffers {
    Buffer<uint> numbers;
    Buffer<float> results;
};

void bind(ArgumentBinder& binder, const NumberedBuffers& buffers)
{
    bind(binder, buffers.numbers);
    bind(binder, buffers.results);
}

TEST_F(DeviceKernel, BindsCompositesByTheirOwnFunction)
{
    const Kernel weigh = Kernel::from_source(device_, "weigh", "Weigh", block_source);
    const NumberedBuffers buffers{{device_, std::vector<uint>(4, 49u), "numbers"}, {device_, 4, "results"}};
    ParameterBlock block{};
    block.weights[49] = 2.0f;
    block.tint.y = 3.0f;
    weigh(4, buffers, block, 4u, ulong(0));
    EXPECT_EQ(buffers.results.download(), std::vector<float>(4, 6.0f));
}

// Rounded up to whole groups, every item runs once, whatever the group size; a group size of its own wins.
TEST_F(DeviceKernel, RunsEveryItemOnceForAnyGroupSize)
{
    constexpr std::string_view source = R"(
        __kernel void visit(__global uint* visits, __global uint* group_size, const uint count)
        {
            uint i = get_global_id(0);
            if (i == 0u) group_size[0] = (uint)get_local_size(0);
            if (i < count) atomic_inc(&visits[i]);
        })";
    const Kernel visit = Kernel::from_source(device_, "visit", "Visit", source);
    Buffer<uint> group_size(device_, 1, "group size");
    for (const std::size_t group : {1, 7, 64, 256, 4096}) {
        device_.set_work_group_size(group);
        for (const std::size_t items : {1, 1000, 70'000, 5}) {
            Buffer<uint> visits(device_, items, "visits");
            visits.fill(0u);
            visit(items, visits, group_size, uint(items));
            ASSERT_EQ(visits.download(), std::vector<uint>(items, 1u)) << group << " " << items;
            EXPECT_EQ(group_size.read(0), device_.work_group_size());
        }
    }
    Buffer<uint> visits(device_, 10, "visits");
    visits.fill(0u);
    visit.launch_grouped(10, 2, visits, group_size, 10u);
    EXPECT_EQ(group_size.read(0), 2u);
    EXPECT_EQ(visits.download(), std::vector<uint>(10, 1u));
}

TEST_F(DeviceKernel, DoesNothingForNoItems)
{
    const Kernel write = Kernel::from_source(device_, "write", "Write", "__kernel void write(__global uint* o) { o[0] = 1u; }");
    Buffer<uint> output(device_, 1, "output");
    output.fill(0u);
    write(0, output);
    EXPECT_EQ(output.read(0), 0u);
    EXPECT_THAT(message_of([&] { write(0, output, output); }), HasSubstr("1 arguments"));
}

TEST_F(DeviceKernel, ReportsTheBuildLogWithFilesOfTheSources)
{
    try {
        Kernel::from_source(device_, "broken", "Broken",
                            "#include \"shared/ray.h\"\n\n__kernel void broken(__global Ray* r)\n{ r->nonsense = 1; }\n");
        FAIL() << "it builds";
    } catch (const DeviceError& error) {
        EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("clBuildProgram"), HasSubstr("'broken'"), HasSubstr(device_.info().name),
                                                 HasSubstr("CL_BUILD_PROGRAM_FAILURE (-11)"), HasSubstr("nonsense")));
    }
    try {
        Kernel::from_source(device_, "absent", "Absent", "__kernel void present(__global int* o) { o[0] = 1; }");
        FAIL() << "there is no such kernel";
    } catch (const DeviceError& error) {
        EXPECT_THAT(error.what(),
                    testing::AllOf(HasSubstr("clCreateKernel"), HasSubstr("'absent'"), HasSubstr("CL_INVALID_KERNEL_NAME (-46)")));
    }
    EXPECT_THAT(message_of([&] { Kernel(device_, "no_such_stage", "None"); }), HasSubstr("stages/no_such_stage.cl"));
}

TEST_F(DeviceKernel, NamesFileAndLineInTheBuildLog)
{
    if (device_.info().name.starts_with("Oclgrind")) GTEST_SKIP() << "the simulator strips #line directives";
    try {
        Kernel::from_source(device_, "broken", "Broken",
                            "#include \"shared/ray.h\"\n\n__kernel void broken(__global Ray* r)\n{ r->nonsense = 1; }\n");
        FAIL() << "it builds";
    } catch (const DeviceError& error) {
        EXPECT_THAT(error.what(), HasSubstr("broken.cl:4"));
    }
}

TEST_F(DeviceKernel, SharesProgramsOfOneSource)
{
    const std::string source = "__kernel void shared_program(__global int* o) { o[get_global_id(0)] = 1; }";
    const Kernel first = Kernel::from_source(device_, "shared_program", "First", source);
    const Kernel second = Kernel::from_source(device_, "shared_program", "Second", source);
    EXPECT_EQ(device_.profile().programs_built() + device_.profile().programs_loaded(), 1u);
}

TEST_F(DeviceKernel, KeepsProgramsForTheNextOfTheirKernels)
{
    const std::string source = "__kernel void kept_program(__global int* o) { o[get_global_id(0)] = 1; }";
    { const Kernel gone = Kernel::from_source(device_, "kept_program", "First", source); }
    const Kernel next = Kernel::from_source(device_, "kept_program", "Second", source);
    EXPECT_EQ(device_.profile().programs_built() + device_.profile().programs_loaded(), 1u);
}

TEST_F(DeviceKernel, ProfilesEveryLaunchByLabel)
{
    const Kernel one =
        Kernel::from_source(device_, "one", "First phrase", "__kernel void one(__global int* o) { o[get_global_id(0)] = 1; }");
    const Kernel two =
        Kernel::from_source(device_, "two", "Second phrase", "__kernel void two(__global int* o) { o[get_global_id(0)] = 2; }");
    Buffer<int> output(device_, 256, "output");
    two(256, output);
    for (int i = 0; i < 10'000; ++i) one(256, output); // far more than are kept as events
    two(256, output);
    const auto stages = device_.profile().stages();
    ASSERT_EQ(stages.size(), 2u);
    EXPECT_EQ(stages[0].label, "Second phrase");
    EXPECT_EQ(stages[0].launches, 2u);
    EXPECT_EQ(stages[1].label, "First phrase");
    EXPECT_EQ(stages[1].launches, 10'000u);
    EXPECT_GT(stages[1].seconds, 0.0);
    EXPECT_LT(stages[1].seconds, 60.0);
    EXPECT_GT(device_.profile().build_seconds(), 0.0);
    device_.profile().reset();
    EXPECT_TRUE(device_.profile().stages().empty());
    one(256, output);
    EXPECT_EQ(device_.profile().stages().at(0).launches, 1u);
}

TEST_F(DeviceKernel, ServesTwoDevicesSideBySide)
{
    Device other(select_device(""));
    const std::string source = "__kernel void add(__global int* o, const int step) { o[get_global_id(0)] += step; }";
    const Kernel here = Kernel::from_source(device_, "add", "Add", source), there = Kernel::from_source(other, "add", "Add", source);
    other.set_work_group_size(16);
    Buffer<int> a(device_, std::vector<int>(256, 1), "a"), b(other, std::vector<int>(256, 10), "b");
    for (int i = 0; i < 100; ++i) {
        here(256, a, 1);
        there(256, b, 2);
    }
    EXPECT_EQ(a.download(), std::vector<int>(256, 101));
    EXPECT_EQ(b.download(), std::vector<int>(256, 210));
}

} // namespace
} // namespace sundog
