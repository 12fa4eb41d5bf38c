#include "scene/shutter.h"

#include "math/mix_bits.h"

namespace sundog
{

double pass_time(const Shutter& shutter, std::uint64_t seed, std::uint64_t pass)
{
    // Digit k after the point is the pass's k-th lowest bit, turned over by a coin that belongs to the digits before it.
    constexpr int digits = 53;
    const std::uint64_t start = mix_bits(seed ^ 0x6d6f74696f6e2062u); // apart from what else the seed chooses for a pass
    std::uint64_t share = 0;
    for (int k = 0; k < digits; k++) {
        const std::uint64_t before = pass & ((std::uint64_t{1} << k) - 1);
        const std::uint64_t coin = mix_bits(mix_bits(start + static_cast<std::uint64_t>(k)) ^ before) >> 63;
        share = share << 1 | ((pass >> k & 1) ^ coin);
    }
    return shutter.open + static_cast<double>(share) * 0x1p-53 * (shutter.close - shutter.open);
}

} // namespace sundog
