// The random numbers of paths in plain C++, and which of them decides what: the one place to change when a kernel
// takes another dimension.
#pragma once

#include "shared/sampler.h"

#include <array>
#include <cstdint>

namespace sundog
{

// Philox4x32-10 [Salmon et al. 2011, Parallel Random Numbers: As Easy as 1, 2, 3, section 3.3].
inline std::array<uint, 4> plain_philox(std::array<uint, 4> counter, std::array<uint, 2> key)
{
    const auto high = [](std::uint64_t product) { return static_cast<uint>(product >> 32); };
    const auto low = [](std::uint64_t product) { return static_cast<uint>(product); };
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t first = std::uint64_t(0xd2511f53) * counter[0], second = std::uint64_t(0xcd9e8d57) * counter[2];
        counter = {high(second) ^ counter[1] ^ key[0], low(second), high(first) ^ counter[3] ^ key[1], low(first)};
        key[0] += 0x9e3779b9; // the golden ratio
        key[1] += 0xbb67ae85; // sqrt(3) - 1
    }
    return counter;
}

using Pair = std::array<double, 2>;

struct LightNumbers {
    double choice; // of all 32 bits
    Pair position; // on an area light, or the direction to a constant environment
};

struct EmissionNumbers {
    LightNumbers light; // a distant light's position lies on the disk that faces the scene
    Pair direction;
};

struct LensNumbers {
    Pair position;
    Pair pixel; // which of the pixels that a filter covers, along x and y
};

struct ScatterNumbers {
    Pair direction;
    double lobe;
    double survival;
};

// The independent sampler: Philox under the seed as key; the counter is the point's index (64 bits), the sequence, and
// the block of four dimensions, with the stream above it. Vertex d of a path owns blocks 3 d, 3 d + 1 and 3 d + 2.
class PlainNumbers
{
public:
    // Pixels, numbered row by row, are sequences; iterations are points.
    static PlainNumbers camera(SamplerKey key, uint pixel) { return {key, STREAM_CAMERA, pixel, iteration(key)}; }
    // One sequence for all light paths of all iterations.
    static PlainNumbers light(SamplerKey key, uint path, uint paths) { return {key, STREAM_LIGHT, 0, iteration(key) * paths + path}; }

    EmissionNumbers emission() const
    {
        const auto v = block(0, 1);
        return {direct_light(0), {v[0], v[1]}};
    }
    LightNumbers direct_light(uint vertex) const
    {
        const auto u = block(vertex, 0);
        return {words(vertex, 0)[2] / 4294967296.0, {u[0], u[1]}};
    }
    LensNumbers lens(uint vertex) const
    {
        const auto u = block(vertex, 0);
        return {{u[0], u[1]}, {u[2], u[3]}};
    }
    // `blocks`: how many of the vertex's blocks went before, to a light or the lens and to the choice of a lobe.
    ScatterNumbers scatter(uint vertex, uint blocks) const
    {
        const auto u = block(vertex, blocks);
        return {{u[0], u[1]}, u[2], u[3]};
    }

private:
    PlainNumbers(SamplerKey key, uint stream, uint sequence, std::uint64_t index)
        : key_{key.seed_low, key.seed_high}, stream_(stream), sequence_(sequence), index_(index)
    {
    }

    static std::uint64_t iteration(SamplerKey key) { return (std::uint64_t(key.iteration_high) << 32) + key.iteration_low; }

    std::array<uint, 4> words(uint vertex, uint number) const
    {
        return plain_philox({static_cast<uint>(index_), static_cast<uint>(index_ >> 32), sequence_, (stream_ << 28) + 3 * vertex + number}, key_);
    }

    // The upper 24 bits of each word, as a fraction.
    std::array<double, 4> block(uint vertex, uint number) const
    {
        const auto drawn = words(vertex, number);
        std::array<double, 4> fractions{};
        for (std::size_t i = 0; i < 4; ++i) fractions[i] = (drawn[i] >> 8) / 16777216.0;
        return fractions;
    }

    std::array<uint, 2> key_;
    uint stream_, sequence_;
    std::uint64_t index_;
};

} // namespace sundog
