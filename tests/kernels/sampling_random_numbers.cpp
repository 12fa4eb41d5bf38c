// The counter-based generator: its published answers, and that numbers of different paths, iterations, dimensions,
// streams and seeds are uniform and independent.
#include "stages/sampling.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"
#include "support/plain_random.h"

#include <array>

namespace sundog
{
namespace
{

constexpr int tests_in_file = 12;

class RandomNumbers : public DeviceFixture
{
};

struct PhiloxAnswer {
    std::array<uint, 4> counter;
    std::array<uint, 2> key;
    std::array<uint, 4> result;
};

// From Random123's table of known answers.
const std::vector<PhiloxAnswer> known_answers = {
    {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
    {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}, {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
    {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}, {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
};

TEST_F(RandomNumbers, PhiloxGivesItsKnownAnswers)
{
    const Kernel philox = test_kernel(R"(
        __kernel void test(__global const uint* input, uint count, __global uint* output)
        {
            uint i = get_global_id(0);
            if (i >= count) return;
            __global const uint* in = input + 6u * i;
            vstore4(philox4x32(vload4(0, in), vload2(2, in)), i, output);
        })");
    std::vector<uint> input;
    for (const auto& answer : known_answers) {
        input.insert(input.end(), answer.counter.begin(), answer.counter.end());
        input.insert(input.end(), answer.key.begin(), answer.key.end());
    }
    const auto output = allocate<uint>(4 * known_answers.size());
    philox(known_answers.size(), upload(input), static_cast<uint>(known_answers.size()), output);
    const std::vector<uint> results = output.download();
    for (std::size_t i = 0; i < known_answers.size(); ++i)
        for (std::size_t word = 0; word < 4; ++word)
            EXPECT_EQ(results[4 * i + word], known_answers[i].result[word]) << "case " << i << ", word " << word;
}

// What other tests take their random numbers from.
TEST(PlainRandomNumbers, PhiloxGivesItsKnownAnswers)
{
    for (const auto& answer : known_answers) EXPECT_EQ(plain_philox(answer.counter, answer.key), answer.result);
}

// Work-item i draws `blocks` blocks of four numbers for path i of the iteration.
const std::string draw_source = R"(
    #include "math/sampler.h"
    __kernel void test(SamplerKey key, uint stream, uint paths, uint depth, uint blocks, __global float* output)
    {
        uint i = get_global_id(0);
        if (i >= paths) return;
        Sampler sampler = stream == STREAM_LIGHT ? light_sampler(key, i, paths, depth) : camera_sampler(key, i, depth);
        for (uint block = 0u; block < blocks; ++block) vstore4(next_4d(&sampler), blocks * i + block, output);
    })";

class IndependentSampler : public RandomNumbers
{
protected:
    // numbers[4 * blocks * path + dimension]
    std::vector<float> draw(SamplerKey key, uint stream, uint depth = 0, uint blocks = 1)
    {
        const auto output = allocate<float>(std::size_t(4) * blocks * paths);
        draw_(paths, key, stream, paths, depth, blocks, output);
        return output.download();
    }

    // Counts of the pairs (a_i, b_i) on a 32 x 32 grid.
    static std::vector<double> joint_counts(const std::vector<float>& a, std::size_t first_a, const std::vector<float>& b,
                                            std::size_t first_b, std::size_t stride = 4)
    {
        constexpr std::size_t cells = 32;
        std::vector<double> counts(cells * cells, 0.0);
        for (std::size_t i = 0; first_a + stride * i < a.size() && first_b + stride * i < b.size(); ++i) {
            const auto cell = [](float x) { return static_cast<std::size_t>(x * cells); };
            counts.at(cell(a[first_a + stride * i]) * cells + cell(b[first_b + stride * i])) += 1.0;
        }
        return counts;
    }

    static constexpr uint paths = 1 << 17;

private:
    Kernel draw_ = [this] {
        BuildOptions options;
        use_sampler(options, SamplerKind::independent);
        return test_kernel(draw_source, options);
    }();
};

TEST_F(IndependentSampler, IsUniformInEachDimension)
{
    const auto numbers = draw(sampler_key(3, 0), STREAM_CAMERA);
    for (std::size_t dimension = 0; dimension < 4; ++dimension) {
        std::vector<double> counts(1024, 0.0);
        for (std::size_t i = dimension; i < numbers.size(); i += 4) counts.at(static_cast<std::size_t>(numbers[i] * 1024.0f)) += 1.0;
        EXPECT_TRUE(is_uniform(counts, tests_in_file)) << "dimension " << dimension;
    }
}

// Bit for bit what plain code makes of the definition, for both streams and with all halves of the key in use.
TEST_F(IndependentSampler, GivesThePlainNumbers)
{
    const SamplerKey key = sampler_key(0x0123456789abcdef, (std::uint64_t(3) << 32) + 5);
    constexpr uint depth = 3;
    const auto camera = draw(key, STREAM_CAMERA, depth, 2), light = draw(key, STREAM_LIGHT, depth, 2);
    for (uint path = 0; path < paths; path += 97) {
        const auto pixel = PlainNumbers::camera(key, path).lens(depth);
        const auto scatter = PlainNumbers::light(key, path, paths).scatter(depth, true);
        const float* first = &camera[8 * path];
        const float* second = &light[8 * path + 4];
        ASSERT_EQ((std::array<double, 4>{first[0], first[1], first[2], first[3]}),
                  (std::array<double, 4>{pixel.position[0], pixel.position[1], pixel.pixel[0], pixel.pixel[1]}));
        ASSERT_EQ((std::array<double, 4>{second[0], second[1], second[2], second[3]}),
                  (std::array<double, 4>{scatter.direction[0], scatter.direction[1], scatter.lobe, scatter.survival}));
    }
}

TEST_F(IndependentSampler, DimensionsAreIndependent)
{
    const auto numbers = draw(sampler_key(4, 0), STREAM_CAMERA, 2, 2);
    EXPECT_TRUE(is_uniform(joint_counts(numbers, 0, numbers, 1, 8), tests_in_file)) << "within a block";
    EXPECT_TRUE(is_uniform(joint_counts(numbers, 3, numbers, 4, 8), tests_in_file)) << "from block to block";
}

TEST_F(IndependentSampler, PathsIterationsStreamsDepthsAndSeedsAreIndependent)
{
    const SamplerKey key = sampler_key(5, 7);
    const auto numbers = draw(key, STREAM_LIGHT);
    EXPECT_TRUE(is_uniform(joint_counts(numbers, 0, numbers, 4), tests_in_file)) << "neighbouring paths";
    EXPECT_TRUE(is_uniform(joint_counts(numbers, 0, draw(sampler_key(5, 8), STREAM_LIGHT), 0), tests_in_file)) << "iterations";
    EXPECT_TRUE(is_uniform(joint_counts(numbers, 0, draw(key, STREAM_CAMERA), 0), tests_in_file)) << "streams";
    EXPECT_TRUE(is_uniform(joint_counts(numbers, 0, draw(key, STREAM_LIGHT, 1), 0), tests_in_file)) << "vertices";
    EXPECT_TRUE(is_uniform(joint_counts(numbers, 0, draw(sampler_key(6, 7), STREAM_LIGHT), 0), tests_in_file)) << "seeds";
    EXPECT_TRUE(is_uniform(joint_counts(numbers, 0, draw(sampler_key(5ull + (1ull << 32), 7), STREAM_LIGHT), 0), tests_in_file))
        << "upper half of the seed";
}

// Path i of iteration k is number k * paths + i of one sequence, also beyond 2^32.
TEST_F(IndependentSampler, IsAPureFunctionOfItsKey)
{
    const auto numbers = draw(sampler_key(9, 3), STREAM_LIGHT);
    EXPECT_EQ(numbers, draw(sampler_key(9, 3), STREAM_LIGHT));
    const std::uint64_t beyond = (std::uint64_t(1) << 32) / paths; // iteration whose first index is 2^32
    EXPECT_NE(draw(sampler_key(9, 0), STREAM_LIGHT), draw(sampler_key(9, beyond), STREAM_LIGHT));
    for (const float number : numbers) {
        ASSERT_GE(number, 0.0f);
        ASSERT_LT(number, 1.0f);
    }
}

} // namespace
} // namespace sundog
