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

    void expect_random_sorted(KeySort& sort, std::size_t count, uint range)
    {
        std::vector<uint> keys(count);
        for (uint& key : keys) key = static_cast<uint>(random_() % range);
        expect_sorted(sort, keys, range, "random");
        for (uint& key : keys) key = random_() % 4 == 0 ? static_cast<uint>(random_() % range) : range / 2; // most in one run
        expect_sorted(sort, keys, range, "crowded");
    }

    void expect_sorted(KeySort& sort, const std::vector<uint>& keys, uint range, const char* what)
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
    std::mt19937 random_{42};
};

TEST_P(KeySortStage, EqualsStableSort)
{
    const uint range = GetParam().key_range;
    KeySort sort(device_, 100'003, range, GetParam().digit_bits);
    // Large before small, so that what an earlier sort left behind would show.
    for (const std::size_t count : {100'003, 8, 0, 7, 1, 1500}) expect_random_sorted(sort, count, range);
    expect_random_sorted(sort, 5000, std::min(range, 13u)); // a smaller range than the sort was made for
    expect_random_sorted(sort, 5000, range);
}

// Few enough keys for a simulator that checks every access.
TEST_P(KeySortStage, SortsShortLists)
{
    const uint range = std::min(GetParam().key_range, 1000u);
    KeySort sort(device_, 1000, range, GetParam().digit_bits);
    for (const std::size_t count : {1000, 0, 1, 8, 13}) expect_random_sorted(sort, count, range);
    expect_sorted(sort, std::vector<uint>(1000, range - 1), range, "all the largest");
    expect_sorted(sort, std::vector<uint>(1000, 0u), range, "all the smallest");
}

INSTANTIATE_TEST_SUITE_P(Ways, KeySortStage,
                         testing::Values(SortCase{"OnePass", false, 0, 5000}, SortCase{"OnePassOfAPowerOfTwo", false, 0, 4096},
                                         SortCase{"TwoKeys", false, 0, 2}, SortCase{"FourBits", false, 4, 5000},
                                         SortCase{"EightBits", false, 8, 70'001}, SortCase{"AsGpu", true, 0, 70'001},
                                         SortCase{"AsGpuFourBits", true, 4, 300}),
                         [](const auto& sort_case) { return sort_case.param.name; });

} // namespace
} // namespace sundog
