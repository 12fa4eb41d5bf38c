// What Markov chains propose: independent numbers are uniform and independent of each other, and small steps are as long as
// [Kelemen et al. 2002, section 3.2] has them, as often up as down.
#include "support/chi_squared.h"
#include "support/device_fixture.h"

namespace sundog
{
namespace
{

constexpr int tests_in_file = 14;
constexpr uint paths = 1 << 17;

class Mutations : public DeviceFixture
{
protected:
    // Words of block `block` of the numbers that the seeds (i, second + i * stride) stand for.
    std::vector<uint> seeded_words(uint block, uint second = 7, uint stride = 0)
    {
        const auto output = allocate<uint>(std::size_t(4) * paths);
        seeded_words_(paths, block, second, stride, output);
        return output.download();
    }

    static std::vector<double> joint_counts(const std::vector<uint>& a, std::size_t first_a, const std::vector<uint>& b,
                                            std::size_t first_b)
    {
        std::vector<double> counts(1024, 0.0);
        for (std::size_t i = 0; i < paths; ++i) counts.at((a[4 * i + first_a] >> 27) * 32 + (b[4 * i + first_b] >> 27)) += 1.0;
        return counts;
    }

private:
    Kernel seeded_words_ = test_kernel(R"(
        #include "math/chain_numbers.h"
        __kernel void test(uint block, uint second, uint stride, __global uint* output)
        {
            const uint i = get_global_id(0);
            vstore4(seeded_words((uint2)(i, second + i * stride), block), i, output);
        })");
};

TEST_F(Mutations, IndependentNumbersAreUniform)
{
    const std::vector<uint> words = seeded_words(0);
    for (std::size_t lane = 0; lane < 4; ++lane) {
        std::vector<double> counts(1024, 0.0);
        for (std::size_t i = lane; i < words.size(); i += 4) counts.at(words[i] >> 22) += 1.0;
        EXPECT_TRUE(is_uniform(counts, tests_in_file)) << "lane " << lane;
    }
}

TEST_F(Mutations, IndependentNumbersAreIndependent)
{
    const std::vector<uint> words = seeded_words(0), next = seeded_words(1), other = seeded_words(0, 8), both = seeded_words(0, 7, 1);
    EXPECT_TRUE(is_uniform(joint_counts(words, 0, words, 1), tests_in_file)) << "lanes";
    EXPECT_TRUE(is_uniform(joint_counts(words, 2, words, 3), tests_in_file)) << "lanes";
    EXPECT_TRUE(is_uniform(joint_counts(words, 0, next, 0), tests_in_file)) << "blocks";
    EXPECT_TRUE(is_uniform(joint_counts(words, 0, other, 0), tests_in_file)) << "the seeds' second word";
    EXPECT_TRUE(is_uniform(joint_counts(both, 0, both, 2), tests_in_file)) << "both of the seeds' words";
    std::vector<uint> shifted(words.begin() + 4, words.end()); // that of the seed after it
    shifted.insert(shifted.end(), words.begin(), words.begin() + 4);
    EXPECT_TRUE(is_uniform(joint_counts(words, 0, shifted, 0), tests_in_file)) << "the seeds' first word";
}

class SmallSteps : public DeviceFixture
{
protected:
    // Signed lengths, as fractions of 1, of paths * 4 steps from coordinates that reach both ends.
    std::vector<double> lengths()
    {
        const auto output = allocate<uint>(std::size_t(8) * paths);
        step_(paths, output);
        const std::vector<uint> words = output.download();
        std::vector<double> lengths;
        for (std::size_t i = 0; i < paths; ++i)
            for (std::size_t lane = 0; lane < 4; ++lane)
                lengths.push_back(static_cast<std::int32_t>(words[8 * i + 4 + lane] - words[8 * i + lane]) * 0x1p-32);
        return lengths;
    }

private:
    Kernel step_ = test_kernel(R"(
        #include "math/chain_numbers.h"
        __kernel void test(__global uint* output)
        {
            const uint i = get_global_id(0);
            // Even ones lie within 2^-8 of the ends, where steps wrap around.
            const uint4 random = random_words(i, 1u);
            const uint4 from = i % 2u ? random : random / 128u - (1u << 24);
            vstore4(from, 2u * i, output);
            vstore4(small_step(from, random_words(i, 2u)), 2u * i + 1u, output);
        })");
};

// s2 exp(-ln(s2 / s1) xi): the logarithm is uniform.
TEST_F(SmallSteps, AreLogUniformBetweenTheirBounds)
{
    constexpr double shortest = 1.0 / 1024, longest = 1.0 / 64;
    std::vector<double> counts(256, 0.0);
    for (double length : lengths()) {
        ASSERT_GE(std::abs(length), shortest * (1 - 1e-5));
        ASSERT_LE(std::abs(length), longest * (1 + 1e-5));
        const double xi = std::log(longest / std::abs(length)) / std::log(longest / shortest);
        counts.at(static_cast<std::size_t>(std::clamp(xi, 0.0, 1 - 1e-12) * 256)) += 1.0;
    }
    EXPECT_TRUE(is_uniform(counts, tests_in_file));
}

// For each length: a proposal is as likely as its reverse, which the acceptance of [Kelemen et al. 2002] relies on.
TEST_F(SmallSteps, GoUpAsOftenAsDown)
{
    std::vector<double> counts(32, 0.0);
    for (double length : lengths()) {
        const auto octave = static_cast<std::size_t>(std::clamp(std::log2(std::abs(length)) + 10.0, 0.0, 3.999) * 4);
        counts.at(2 * octave + (length > 0 ? 1 : 0)) += 1.0;
    }
    EXPECT_TRUE(is_uniform(counts, tests_in_file));
}

} // namespace
} // namespace sundog
