// Hashing of 64-bit words.
#pragma once

#include <cstdint>

namespace sundog
{

// A bijection [Steele, Lea and Flood 2014], the finaliser of SplitMix64.
inline std::uint64_t mix_bits(std::uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

} // namespace sundog
