// The times of passes: stratified and uniform.
#include "scene/shutter.h"
#include "support/chi_squared.h"

#include <gtest/gtest.h>

#include <set>

namespace sundog
{
namespace
{

TEST(Shutter, AlignedPowersOfTwoHaveOneTimeInEachPart)
{
    for (std::uint64_t seed : {0u, 1u, 77u}) {
        for (std::uint64_t count : {2u, 8u, 64u, 1024u}) {
            for (std::uint64_t first : {std::uint64_t{0}, 3 * count, (std::uint64_t{1} << 40)}) {
                std::set<int> parts;
                for (std::uint64_t i = 0; i < count; i++) {
                    const double time = pass_time({2.0, 6.0}, seed, first + i);
                    EXPECT_GE(time, 2.0);
                    EXPECT_LT(time, 6.0);
                    parts.insert(static_cast<int>((time - 2.0) / 4.0 * static_cast<double>(count)));
                }
                EXPECT_EQ(parts.size(), count) << "seed " << seed << ", from " << first;
            }
        }
    }
}

TEST(Shutter, APureFunctionOfSeedAndPass)
{
    EXPECT_EQ(pass_time({0, 1}, 5, 9), pass_time({0, 1}, 5, 9));
    EXPECT_NE(pass_time({0, 1}, 5, 9), pass_time({0, 1}, 6, 9));
    EXPECT_NE(pass_time({0, 1}, 5, 9), pass_time({0, 1}, 5, 10));
    EXPECT_EQ(pass_time({3, 3}, 5, 9), 3.0) << "no time";
}

// Over seeds the time of a pass is uniform, and neighbouring seeds have nothing to do with each other.
TEST(Shutter, UniformOverSeeds)
{
    constexpr std::size_t bins = 16;
    constexpr int tests = 8;
    for (std::uint64_t pass : {0u, 1u, 6u, 1000u}) {
        std::vector<double> alone(bins), pairs(bins * bins);
        const auto bin = [&](std::uint64_t seed) { return static_cast<std::size_t>(bins * pass_time({0, 1}, seed, pass)); };
        for (std::uint64_t seed = 0; seed < 16384; seed++) {
            alone[bin(2 * seed)]++;
            pairs[bin(2 * seed) * bins + bin(2 * seed + 1)]++;
        }
        EXPECT_TRUE(is_uniform(alone, tests)) << "pass " << pass;
        EXPECT_TRUE(is_uniform(pairs, tests)) << "pass " << pass;
    }
}

// Within a part of the time passes come in any place: the coins of later digits are not those of earlier ones.
TEST(Shutter, UniformWithinParts)
{
    constexpr std::size_t bins = 16;
    std::vector<double> within(bins), in_half(2 * bins);
    for (std::uint64_t seed = 0; seed < 64; seed++)
        for (std::uint64_t pass = 0; pass < 256; pass++) {
            const double place = 256 * pass_time({0, 1}, seed, pass), rest = place - std::floor(place);
            within[static_cast<std::size_t>(bins * rest)]++;
            in_half[static_cast<std::size_t>(bins * rest) + (place < 128 ? 0 : bins)]++;
        }
    EXPECT_TRUE(is_uniform(within, 2));
    EXPECT_TRUE(is_uniform(in_half, 2));
}

} // namespace
} // namespace sundog
