// Ordered compaction and record lists against plain loops.
#include "math/vec3.h"
#include "shared/photon.h"
#include "stages/compaction.h"
#include "support/device_fixture.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace sundog
{
namespace
{

class CompactionStage : public DeviceFixture
{
protected:
    static std::vector<uint> random_flags(std::size_t count, uint seed)
    {
        std::mt19937 random(seed);
        std::vector<uint> flags(count);
        for (uint& flag : flags) flag = static_cast<uint>(random() % 4); // any of PATH_ALIVE and PATH_DEPOSIT
        return flags;
    }

    static bool same(const Photon& a, const Photon& b)
    {
        return a.position == b.position && a.direction == b.direction && a.flux == b.flux && a.normal_depth == b.normal_depth;
    }
};

TEST_F(CompactionStage, KeepsFlaggedEntriesInOrder)
{
    constexpr std::size_t capacity = 10'000;
    Compaction compaction(device_, capacity);
    for (const std::size_t count : {std::size_t(1), std::size_t(255), std::size_t(256), std::size_t(257), std::size_t(9999)}) {
        std::vector<uint> list(count), expected;
        std::iota(list.begin(), list.end(), 1000u);
        std::reverse(list.begin(), list.end());
        const std::vector<uint> flags = random_flags(count, 5);
        for (std::size_t i = 0; i < count; ++i)
            if (flags[i] & PATH_ALIVE) expected.push_back(list[i]);
        auto shorter = allocate<uint>(capacity), shorter_count = allocate<uint>(1);
        // The host may know no more than an upper bound of the number of items.
        for (const std::size_t bound : {count, capacity}) {
            auto device_list = allocate<uint>(capacity), device_flags = allocate<uint>(capacity);
            device_list.upload(list);
            device_flags.fill(PATH_ALIVE); // beyond the list: not to be counted
            device_flags.upload(flags);
            compaction.keep(device_list, device_flags, upload(std::vector{static_cast<uint>(count)}), bound, PATH_ALIVE, shorter,
                            shorter_count);
            ASSERT_EQ(shorter_count.read(0), expected.size());
            ASSERT_EQ(shorter.download(0, expected.size()), expected);
        }
    }
}

TEST_F(CompactionStage, NothingKeptAndAllKept)
{
    Compaction compaction(device_, 600);
    std::vector<uint> list(600);
    std::iota(list.begin(), list.end(), 0u);
    auto shorter = allocate<uint>(600), shorter_count = allocate<uint>(1);
    const auto count = upload(std::vector<uint>{600});
    compaction.keep(upload(list), upload(std::vector<uint>(600, PATH_DEPOSIT)), count, 600, PATH_ALIVE, shorter, shorter_count);
    EXPECT_EQ(shorter_count.read(0), 0u);
    compaction.keep(upload(list), upload(std::vector<uint>(600, PATH_ALIVE | PATH_DEPOSIT)), count, 600, PATH_ALIVE, shorter,
                    shorter_count);
    EXPECT_EQ(shorter_count.read(0), 600u);
    EXPECT_EQ(shorter.download(), list);
}

// Rather than wrap, so that whoever reads the total can tell that there were too many.
TEST_F(CompactionStage, CountsBeyond32BitsStayAtTheLargest)
{
    const std::vector<uint> items = {0x80000000u, 0x7fffffffu, 5u, 7u};
    const auto item_count = upload(std::vector<uint>{static_cast<uint>(items.size())});
    const auto chunk_counts = allocate<uint>(1), total = allocate<uint>(1);
    Kernel(device_, "sum_item_counts", "Sum")(1, upload(items), item_count, 1u, chunk_counts);
    EXPECT_EQ(chunk_counts.read(0), 0xffffffffu);
    const auto counts = upload(items);
    Kernel(device_, "scan_counts", "Scan").launch_grouped(1, 1, counts, 4u, 0u, total);
    EXPECT_EQ(total.read(0), 0xffffffffu);
    EXPECT_EQ(counts.download(), (std::vector<uint>{0u, 0x80000000u, 0xffffffffu, 0xffffffffu}));
}

TEST_F(CompactionStage, RecordsAreAppendedInOrderAndGrowWhenThereAreTooMany)
{
    constexpr std::size_t batch = 1000, batches = 3;
    Compaction compaction(device_, batch);
    RecordList<Photon> list(device_, "photons", 700); // too few
    const std::vector<uint> flags = random_flags(batch, 6);
    std::vector<Photon> deposits(batch), expected;
    for (std::size_t i = 0; i < batch; ++i) {
        const float value = static_cast<float>(i);
        deposits[i] = {{value, -value, 0.5f}, static_cast<uint>(i), {1.0f, value, 2.0f}, static_cast<uint>(i * i)};
    }
    for (std::size_t b = 0; b < batches; ++b)
        for (std::size_t i = 0; i < batch; ++i)
            if (flags[i] & PATH_DEPOSIT) expected.push_back(deposits[i]);
    ASSERT_GT(expected.size(), list.capacity());

    const auto append_all = [&] {
        list.clear();
        for (std::size_t b = 0; b < batches; ++b)
            list.append(compaction, upload(deposits), upload(flags), upload(std::vector{static_cast<uint>(batch)}), batch);
    };
    append_all();
    EXPECT_EQ(list.read_count(), expected.size()) << "the count tells how much room is needed";
    const std::vector<Photon> truncated = list.records().download();
    ASSERT_EQ(truncated.size(), 700u);
    for (std::size_t i = 0; i < truncated.size(); ++i) ASSERT_TRUE(same(truncated[i], expected[i])) << i;

    list.grow(list.read_count());
    ASSERT_GE(list.capacity(), expected.size());
    append_all();
    EXPECT_EQ(list.read_count(), expected.size());
    const std::vector<Photon> records = list.records().download(0, expected.size());
    for (std::size_t i = 0; i < records.size(); ++i) ASSERT_TRUE(same(records[i], expected[i])) << i;
}

} // namespace
} // namespace sundog
