// Owen-scrambled Sobol points: nets, independent scramblings, equidistribution, and the error of integrals.
#include "stages/sampling.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"

#include <array>
#include <set>

namespace sundog
{
namespace
{

constexpr int tests_in_file = 8;

class SobolPoints : public DeviceFixture
{
protected:
    using Point = std::array<float, 4>;

    // Points first .. first + count - 1 of the sequence that `seed` names.
    std::vector<Point> points(uint count, uint seed, uint first = 0)
    {
        const auto output = allocate<float>(std::size_t(4) * count);
        sobol_(count, first, count, seed, output);
        const std::vector<float> numbers = output.download();
        std::vector<Point> result(count);
        for (std::size_t i = 0; i < count; ++i) std::copy_n(&numbers[4 * i], 4, result[i].begin());
        return result;
    }

private:
    Kernel sobol_ = test_kernel(R"(
        #include "math/sobol.h"
        __kernel void test(uint first, uint count, uint seed, __global float* output)
        {
            uint i = get_global_id(0);
            if (i < count) vstore4(sobol_owen_4d(first + i, seed), i, output);
        })");
};

uint reversed_bits(uint x)
{
    uint result = 0;
    for (int bit = 0; bit < 32; ++bit) result |= ((x >> bit) & 1u) << (31 - bit);
    return result;
}

// Direction numbers by the recurrence of [Bratley and Fox 1988] from a primitive polynomial of degree s with inner
// coefficients a, and the first s odd numbers m, as [Joe and Kuo 2008] list them.
std::array<uint, 32> direction_numbers(int s, uint a, const std::vector<uint>& m)
{
    std::array<uint, 32> v{};
    for (int i = 0; i < 32; ++i) {
        if (s == 0) {
            v[i] = 1u << (31 - i); // van der Corput
        } else if (i < s) {
            v[i] = m[i] << (31 - i);
        } else {
            v[i] = v[i - s] ^ (v[i - s] >> s);
            for (int k = 1; k < s; ++k) v[i] ^= ((a >> (s - 1 - k)) & 1u) * v[i - k];
        }
    }
    return v;
}

TEST_F(SobolPoints, TableHoldsTheDirectionNumbers)
{
    const Kernel kernel = test_kernel(R"(
        #include "math/sobol.h"
        __kernel void test(uint count, __global uint* output)
        {
            uint i = get_global_id(0);
            if (i < count) output[i] = SOBOL_NIBBLES[i];
        })");
    const auto output = allocate<uint>(8 * 16 * 4);
    kernel(output.size(), static_cast<uint>(output.size()), output);
    const auto table = output.download();
    const std::array<uint, 32> dimensions[4] = {direction_numbers(0, 0, {}), direction_numbers(1, 0, {1}), direction_numbers(2, 1, {1, 3}),
                                                direction_numbers(3, 1, {1, 3, 1})};
    for (uint nibble = 0; nibble < 8; ++nibble)
        for (uint value = 0; value < 16; ++value)
            for (uint dimension = 0; dimension < 4; ++dimension) {
                uint sum = 0;
                for (uint bit = 0; bit < 4; ++bit) sum ^= ((value >> bit) & 1u) * dimensions[dimension][31 - (4 * nibble + bit)];
                ASSERT_EQ(table[4 * (16 * nibble + value) + dimension], reversed_bits(sum))
                    << "nibble " << nibble << ", value " << value << ", dimension " << dimension;
            }
}

// A base-2 sequence: every run of 2^k points that starts at a multiple of 2^k meets each of the 2^k intervals once.
TEST_F(SobolPoints, FillEachDyadicIntervalOnce)
{
    const uint most = 1u << 14;
    for (const uint seed : {0u, 1u, 0xdeadbeefu}) {
        const auto sequence = points(most, seed);
        for (uint count = 1; count <= most; count *= 4)
            for (uint start = 0; start + count <= std::min(most, 4 * count); start += count)
                for (std::size_t dimension = 0; dimension < 4; ++dimension) {
                    std::vector<int> met(count, 0);
                    for (uint i = start; i < start + count; ++i)
                        ++met.at(static_cast<std::size_t>(sequence[i][dimension] * static_cast<float>(count)));
                    ASSERT_EQ(met, std::vector<int>(count, 1))
                        << "seed " << seed << ", points " << start << " to " << start + count << ", dimension " << dimension;
                }
    }
}

// Dimensions 0 and 1 form a (0, 2)-sequence: every elementary rectangle of area 2^-k holds one of 2^k points.
TEST_F(SobolPoints, FirstTwoDimensionsFormANet)
{
    const int most_bits = 12;
    for (const uint seed : {2u, 77u}) {
        const auto sequence = points(1u << most_bits, seed);
        for (int bits = 0; bits <= most_bits; bits += 2)
            for (int across = 0; across <= bits; ++across) {
                const std::size_t columns = std::size_t(1) << across, rows = std::size_t(1) << (bits - across);
                std::vector<int> met(columns * rows, 0);
                for (std::size_t i = 0; i < met.size(); ++i) {
                    const auto x = static_cast<std::size_t>(sequence[i][0] * static_cast<float>(columns));
                    const auto y = static_cast<std::size_t>(sequence[i][1] * static_cast<float>(rows));
                    ++met.at(y * columns + x);
                }
                ASSERT_EQ(met, std::vector<int>(met.size(), 1)) << columns << " x " << rows << " rectangles";
            }
    }
}

TEST_F(SobolPoints, EachSeedIsAnotherScrambling)
{
    std::set<Point> firsts;
    std::vector<double> counts(64, 0.0);
    constexpr uint seeds = 1024;
    for (uint seed = 0; seed < seeds; ++seed) {
        const Point first = points(1, seed).front();
        firsts.insert(first);
        counts.at(static_cast<std::size_t>(first[0] * 8.0f) * 8 + static_cast<std::size_t>(first[1] * 8.0f)) += 1.0;
    }
    EXPECT_EQ(firsts.size(), seeds);
    EXPECT_TRUE(is_uniform(counts, tests_in_file)) << "the first point of scramblings is not uniform";
}

// A scrambling that only shifts would keep the differences between points: Owen's does not.
TEST_F(SobolPoints, ScramblingIsNotAShift)
{
    const auto a = points(256, 11), b = points(256, 12);
    std::set<uint> differences;
    for (std::size_t i = 0; i < a.size(); ++i)
        differences.insert(static_cast<uint>(a[i][0] * 0x1p24f) ^ static_cast<uint>(b[i][0] * 0x1p24f));
    EXPECT_GT(differences.size(), 200u);
}

// Numbers of n that are no power of two: the star discrepancy along each axis stays of order log n / n.
TEST_F(SobolPoints, EquidistributeForAnyNumberOfPoints)
{
    const auto sequence = points(10'007, 5);
    for (const std::size_t count : {3u, 100u, 1000u, 3000u, 10'007u})
        for (std::size_t dimension = 0; dimension < 4; ++dimension) {
            std::vector<double> values;
            for (std::size_t i = 0; i < count; ++i) values.push_back(sequence[i][dimension]);
            std::sort(values.begin(), values.end());
            double discrepancy = 0.0;
            for (std::size_t i = 0; i < count; ++i) {
                const double n = static_cast<double>(count), rank = static_cast<double>(i);
                discrepancy = std::max({discrepancy, values[i] - rank / n, (rank + 1.0) / n - values[i]});
            }
            // [Niederreiter 1992, theorem 3.6]: n D <= 1 + log2(n) / 2 for a one-dimensional sequence of base 2, and a
            // half more for the star discrepancy's open intervals.
            EXPECT_LT(discrepancy * static_cast<double>(count), 1.5 + 0.5 * std::log2(static_cast<double>(count)))
                << count << " points, dimension " << dimension;
        }
}

double smooth(const std::array<float, 4>& x)
{
    double product = 1.0;
    for (int d = 0; d < 4; ++d) product *= 1.0 + 0.5 * (static_cast<double>(x[static_cast<std::size_t>(d)]) - 0.5);
    return product; // integrates to 1
}

// Slope of log RMS error against log n: -1/2 for independent points, near -3/2 for scrambled nets of a smooth function.
TEST_F(SobolPoints, IntegrateSmoothFunctionsFasterThanIndependentPoints)
{
    std::vector<double> log_n, log_error;
    for (uint count = 16; count <= 4096; count *= 4) {
        double squares = 0.0;
        constexpr uint repeats = 32;
        for (uint seed = 0; seed < repeats; ++seed) {
            double sum = 0.0;
            for (const Point& x : points(count, 1000 + seed)) sum += smooth(x);
            squares += std::pow(sum / count - 1.0, 2) / repeats;
        }
        log_n.push_back(std::log(count));
        log_error.push_back(0.5 * std::log(squares));
    }
    const double n = static_cast<double>(log_n.size());
    const double mean_x = std::accumulate(log_n.begin(), log_n.end(), 0.0) / n,
                 mean_y = std::accumulate(log_error.begin(), log_error.end(), 0.0) / n;
    double xy = 0.0, xx = 0.0;
    for (std::size_t i = 0; i < log_n.size(); ++i) {
        xy += (log_n[i] - mean_x) * (log_error[i] - mean_y);
        xx += (log_n[i] - mean_x) * (log_n[i] - mean_x);
    }
    EXPECT_LT(xy / xx, -1.0);
}

class SobolSampler : public DeviceFixture
{
protected:
    std::vector<float> draw(SamplerKey key, uint stream, uint paths, uint depth = 0)
    {
        const auto output = allocate<float>(std::size_t(8) * paths);
        draw_(paths, key, stream, paths, depth, output);
        return output.download();
    }

    // Pearson's correlation of two lists of numbers, each stride apart.
    static double correlation(const std::vector<float>& a, std::size_t first_a, const std::vector<float>& b, std::size_t first_b)
    {
        double sum = 0.0;
        const std::size_t n = a.size() / 8;
        for (std::size_t i = 0; i < n; ++i) sum += (a[8 * i + first_a] - 0.5) * (b[8 * i + first_b] - 0.5);
        return sum * 12.0 / static_cast<double>(n);
    }

private:
    Kernel draw_ = [this] {
        BuildOptions options;
        use_sampler(options, SamplerKind::sobol);
        return test_kernel(R"(
            #include "math/sampler.h"
            __kernel void test(SamplerKey key, uint stream, uint paths, uint depth, __global float* output)
            {
                uint i = get_global_id(0);
                if (i >= paths) return;
                Sampler sampler = stream == STREAM_LIGHT ? light_sampler(key, i, paths, depth) : camera_sampler(key, i, depth);
                vstore4(next_4d(&sampler), 2u * i, output);
                vstore4(next_4d(&sampler), 2u * i + 1u, output);
            })",
                           options);
    }();
};

// Blocks are padded together from independently shuffled and scrambled sequences: pairs of their dimensions look
// independent.
TEST_F(SobolSampler, BlocksVerticesAndSeedsAreUncorrelated)
{
    constexpr uint paths = 1 << 16;
    const double four_sigma = 4.0 / std::sqrt(double(paths));
    const auto numbers = draw(sampler_key(1, 0), STREAM_LIGHT, paths);
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 4; b < 8; ++b)
            EXPECT_LT(std::abs(correlation(numbers, a, numbers, b)), four_sigma) << "dimensions " << a << " and " << b;
    EXPECT_LT(std::abs(correlation(numbers, 0, draw(sampler_key(1, 0), STREAM_LIGHT, paths, 1), 0)), four_sigma) << "vertices";
    EXPECT_LT(std::abs(correlation(numbers, 0, draw(sampler_key(2, 0), STREAM_LIGHT, paths), 0)), four_sigma) << "seeds";
    EXPECT_LT(std::abs(correlation(numbers, 0, draw(sampler_key(1, 0), STREAM_CAMERA, paths), 0)), four_sigma) << "streams";
}

// One iteration's pixels take the same place in differently scrambled sequences: uniform and independent.
TEST_F(SobolSampler, PixelsOfAnIterationAreUniform)
{
    constexpr uint pixels = 1 << 16;
    const auto numbers = draw(sampler_key(21, 5), STREAM_CAMERA, pixels);
    std::vector<double> joint(1024, 0.0), neighbours(1024, 0.0);
    for (std::size_t i = 0; i + 8 < numbers.size(); i += 8) {
        const auto cell = [](float x) { return static_cast<std::size_t>(x * 32.0f); };
        joint[cell(numbers[i]) * 32 + cell(numbers[i + 1])] += 1.0;
        neighbours[cell(numbers[i]) * 32 + cell(numbers[i + 8])] += 1.0;
    }
    EXPECT_TRUE(is_uniform(joint, tests_in_file));
    EXPECT_TRUE(is_uniform(neighbours, tests_in_file));
}

// Light paths of successive iterations continue one sequence: 16 iterations of 2^10 paths are a net of 2^14 points.
TEST_F(SobolSampler, IterationsContinueTheSequenceOfLightPaths)
{
    constexpr uint paths = 1 << 10, iterations = 16;
    std::vector<int> met(paths * iterations, 0);
    for (uint iteration = 0; iteration < iterations; ++iteration) {
        const auto numbers = draw(sampler_key(33, iteration), STREAM_LIGHT, paths);
        for (std::size_t i = 0; i < numbers.size(); i += 8) ++met.at(static_cast<std::size_t>(numbers[i] * static_cast<float>(met.size())));
    }
    EXPECT_EQ(met, std::vector<int>(met.size(), 1));
}

// The same for the iterations of one pixel.
TEST_F(SobolSampler, IterationsOfAPixelFillItEvenly)
{
    constexpr uint iterations = 64;
    std::vector<int> met(iterations, 0);
    for (uint iteration = 0; iteration < iterations; ++iteration) {
        const auto numbers = draw(sampler_key(34, iteration), STREAM_CAMERA, 4);
        const auto cell = [](float x) { return static_cast<std::size_t>(x * 8.0f); };
        ++met.at(cell(numbers[3 * 8]) * 8 + cell(numbers[3 * 8 + 1]));
    }
    EXPECT_EQ(met, std::vector<int>(iterations, 1));
}

} // namespace
} // namespace sundog
