// Device memory: contents, life time, and what is said when there is not enough.
#include "base/errors.h"
#include "device/kernel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace sundog
{
namespace
{

using testing::HasSubstr;

constexpr std::uint64_t mebibyte = 1 << 20;

// A device with little memory, so that running out is cheap.
DeviceInfo small_device(std::uint64_t memory, std::uint64_t largest_buffer)
{
    DeviceInfo info = select_device("");
    info.memory_bytes = memory;
    info.largest_buffer_bytes = largest_buffer;
    return info;
}

TEST(DeviceBuffer, KeepsWhatIsUploaded)
{
    Device device(select_device(""));
    for (const std::size_t count : {1, 3, 1000, 600'000}) { // the last is above 2 MB
        std::vector<int> numbers(count);
        std::iota(numbers.begin(), numbers.end(), -5);
        Buffer<int> buffer(device, numbers, "numbers");
        EXPECT_EQ(buffer.size(), count);
        EXPECT_EQ(buffer.download(), numbers);
        EXPECT_EQ(buffer.read(count - 1), numbers.back());
    }
}

TEST(DeviceBuffer, ReadsAndWritesParts)
{
    Device device(select_device(""));
    Buffer<int> buffer(device, std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}, "numbers");
    buffer.upload(std::vector<int>{-3, -4}, 3);
    EXPECT_EQ(buffer.download(), (std::vector<int>{0, 1, 2, -3, -4, 5, 6, 7}));
    EXPECT_EQ(buffer.download(2, 3), (std::vector<int>{2, -3, -4}));
    EXPECT_TRUE(buffer.download(8, 0).empty());
}

TEST(DeviceBuffer, Fills)
{
    Device device(select_device(""));
    Buffer<float> floats(device, 700'001, "floats");
    floats.fill(2.5f);
    EXPECT_EQ(floats.download(), std::vector<float>(700'001, 2.5f));
    struct Pair {
        std::uint32_t low, high;
    };
    Buffer<Pair> pairs(device, 37, "pairs");
    pairs.fill({7u, 9u});
    for (const Pair& pair : pairs.download()) {
        EXPECT_EQ(pair.low, 7u);
        EXPECT_EQ(pair.high, 9u);
    }
    struct Block {
        std::uint32_t words[32];
    };
    Buffer<Block> blocks(device, 5, "blocks");
    Block block{};
    for (std::uint32_t i = 0; i < 32; ++i) block.words[i] = i;
    blocks.fill(block);
    for (const Block& filled : blocks.download()) EXPECT_TRUE(std::equal(filled.words, filled.words + 32, block.words));
}

TEST(DeviceBuffer, MayBeEmpty)
{
    Device device(select_device(""));
    Buffer<float> none(device, std::vector<float>{}, "none");
    EXPECT_TRUE(none);
    EXPECT_EQ(none.size(), 0u);
    EXPECT_TRUE(none.download().empty());
    none.fill(1.0f);
    EXPECT_FALSE(Buffer<float>());
}

TEST(DeviceBuffer, MovesAndCountsItsBytes)
{
    Device device(select_device(""));
    EXPECT_EQ(device.allocated_bytes(), 0u);
    Buffer<float> target;
    {
        Buffer<float> first(device, std::vector<float>(1024, 1.0f), "first");
        Buffer<float> second(device, std::vector<float>(2048, 2.0f), "second");
        EXPECT_EQ(device.allocated_bytes(), 3u * 4096);
        target = std::move(first);
        target = std::move(second);
    }
    EXPECT_EQ(target.download(), std::vector<float>(2048, 2.0f));
    EXPECT_EQ(device.allocated_bytes(), 2u * 4096);
    EXPECT_EQ(device.peak_bytes(), 3u * 4096);
    target = {};
    EXPECT_EQ(device.allocated_bytes(), 0u);
}

TEST(DeviceBuffer, IsSharedAndCountedOnce)
{
    struct Pair {
        int low, high;
    };
    Device device(select_device(""));
    Buffer<Pair> pairs;
    {
        const Buffer<int> numbers(device, std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}, "numbers");
        pairs = numbers.share_as<Pair>(3, "pairs");
        EXPECT_EQ(device.peak_bytes(), 64u);
        EXPECT_EQ(pairs.read(2).high, 6);
        pairs.upload(std::vector<Pair>{{-1, -2}}, 1);
        EXPECT_EQ(numbers.download(), (std::vector<int>{1, 2, -1, -2, 5, 6, 7, 8}));
    }
    EXPECT_EQ(device.allocated_bytes(), 0u);
    EXPECT_EQ(pairs.size(), 3u);
    EXPECT_EQ(pairs.read(1).low, -1) << "memory goes with its last user";
    pairs = {};
    EXPECT_EQ(device.allocated_bytes(), 0u);
}

TEST(DeviceBuffer, OutlivesAMovedOrClosedDevice)
{
    Buffer<int> buffer;
    {
        Device opened(select_device(""));
        buffer = Buffer<int>(opened, std::vector<int>(100, 3), "numbers");
        Device moved = std::move(opened);
        EXPECT_EQ(buffer.read(99), 3);
        moved.finish();
    }
    EXPECT_EQ(buffer.read(99), 3);
}

// The device still writes into the memory when its owner lets go of it.
TEST(DeviceBuffer, MayBeReleasedWhileInUse)
{
    Device device(select_device(""));
    const Kernel spin = Kernel::from_source(device, "spin", "Spin", R"(
        __kernel void spin(__global float* output)
        {
            float x = 0.5f;
            for (int i = 0; i < 200; ++i) x = 3.9f * x * (1.0f - x);
            output[get_global_id(0)] = x;
        })");
    for (int round = 0; round < 3; ++round) {
        Buffer<float> output(device, 1 << 20, "output");
        spin(1 << 20, output);
    }
    device.finish();
    EXPECT_EQ(device.allocated_bytes(), 0u);
}

TEST(DeviceBuffer, SaysWhatWasAskedWhenTotalMemoryIsShort)
{
    Device device(small_device(64 * mebibyte, 48 * mebibyte));
    Buffer<char> photons(device, 40 * mebibyte, "photons");
    try {
        Buffer<char> queries(device, 30 * mebibyte, "queries");
        FAIL() << "30 MiB fit beside 40 MiB in 64 MiB";
    } catch (const DeviceError& error) {
        EXPECT_THAT(error.what(),
                    testing::AllOf(HasSubstr("'queries' needs 30.0 MiB"), HasSubstr("has 40.0 MiB in buffers"), HasSubstr("64.0 MiB"),
                                   HasSubstr("48.0 MiB in one buffer"), HasSubstr("--device"), HasSubstr(device.info().name)));
        EXPECT_EQ(error.status(), ExitStatus::device);
    }
    EXPECT_EQ(device.allocated_bytes(), 40 * mebibyte);
    photons = {};
    EXPECT_TRUE(Buffer<char>(device, 30 * mebibyte, "queries"));
}

TEST(DeviceBuffer, RefusesWhatIsLargerThanTheLargestBuffer)
{
    Device device(small_device(64 * mebibyte, 16 * mebibyte));
    EXPECT_THROW(Buffer<char>(device, 17 * mebibyte, "film"), DeviceError);
    EXPECT_TRUE(Buffer<char>(device, 16 * mebibyte, "film"));
    Device whole(select_device(""));
    EXPECT_THROW(Buffer<char>(whole, whole.info().largest_buffer_bytes + 1, "film"), DeviceError);
    EXPECT_THROW(Buffer<char>(whole, std::size_t(1) << 60, "film"), DeviceError);
}

// What the driver itself refuses, beyond what it promised.
TEST(DeviceBuffer, ReportsTheDriversOwnRefusal)
{
    const std::uint64_t largest = select_device("").largest_buffer_bytes;
    Device device(small_device(4 * largest, 4 * largest));
    try {
        Buffer<char> film(device, largest + 64, "film");
        GTEST_SKIP() << "the driver gives more than it promises";
    } catch (const DeviceError& error) {
        EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("'film'"), HasSubstr("CL_")));
    }
    EXPECT_EQ(device.allocated_bytes(), 0u);
}

} // namespace
} // namespace sundog
