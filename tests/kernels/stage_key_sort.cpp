// The stable key sort against std::stable_sort: as a CPU divides the work, as a GPU does, and with digits of few bits.
#include "stages/key_sort.h"
#include "support/device_fixture.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace sundog
{
namespace
{

struct SortCase {
    const char* name;
    bool as_gpu; // many short chunks, 8-bit digits
    uint digit_bits;
    uint key_range;
};

class KeySortStage : public testing::TestWithParam<SortCase>
{
protected:
    static DeviceInfo device_info()
    {
        DeviceInfo info = select_device("");
        if (GetParam().as_gpu) info.is_cpu = false;
        return info;
    }

    void expect_sorted(KeySort& sort, const std::vector<uint>& keys, const char* what, uint range = GetParam().key_range)
    {
        SCOPED_TRACE(testing::Message() << what << ", " << keys.size() << " keys");
        sort.keys.upload(keys);
        sort.sort(Buffer<uint>(device_, std::vector{static_cast<uint>(keys.size())}, "count"), keys.size(), range);

        std::vector<uint> order(keys.size());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(), [&](uint a, uint b) { return keys[a] < keys[b]; });
        ASSERT_EQ(sort.order().download(0, keys.size()), order);

        std::vector<uint> ends(range, 0);
        for (const uint key : keys) ++ends.at(key);
        std::partial_sum(ends.begin(), ends.end(), ends.begin());
        ASSERT_EQ(sort.ends().download(sort.ends_offset(), ends.size()), ends);
    }

    Device device_{device_info()};
};

TEST_P(KeySortStage, EqualsStableSort)
{
    constexpr std::size_t capacity = 100'003;
    const uint range = GetParam().key_range;
    KeySort sort(device_, capacity, range, GetParam().digit_bits);
    std::mt19937 random(42);
    // Large before small, so that what an earlier sort left behind would show.
    for (const std::size_t count : {capacity, std::size_t(8), std::size_t(0), std::size_t(7), std::size_t(1), std::size_t(1500)}) {
        std::vector<uint> keys(count);
        for (uint& key : keys) key = static_cast<uint>(random() % range);
        expect_sorted(sort, keys, "random");
        if (HasFatalFailure()) return;
        for (uint& key : keys) key = random() % 4 == 0 ? static_cast<uint>(random() % range) : range / 2; // most in one run
        expect_sorted(sort, keys, "crowded");
        if (HasFatalFailure()) return;
    }
    std::vector<uint> low_keys(5000);
    for (uint& key : low_keys) key = static_cast<uint>(random() % 13);
    expect_sorted(sort, low_keys, "a smaller range", 13);
    expect_sorted(sort, std::vector<uint>(1000, range - 1), "all the largest");
    expect_sorted(sort, std::vector<uint>(1000, 0u), "all the smallest");
}

INSTANTIATE_TEST_SUITE_P(Ways, KeySortStage,
                         testing::Values(SortCase{"OnePass", false, 0, 5000}, SortCase{"OnePassOfAPowerOfTwo", false, 0, 4096}, SortCase{"TwoKeys", false, 0, 2},
                                         SortCase{"FourBits", false, 4, 5000}, SortCase{"EightBits", false, 8, 70'001}, SortCase{"AsGpu", true, 0, 70'001},
                                         SortCase{"AsGpuFourBits", true, 4, 300}),
                         [](const auto& sort_case) { return sort_case.param.name; });

} // namespace
} // namespace sundog
