// When a pass happens.
#pragma once

#include <cstdint>

namespace sundog
{

// The camera sees what there is from `open` to `close` (>= open), each instant as much as any other.
struct Shutter {
    double open = 0.0;
    double close = 0.0;
};

// The one time of a pass, of its camera and of its light: the share of the shutter's time that has passed is the van der
// Corput sequence in base 2 with Owen's scrambling [Owen 1995], so that any 2^k passes that start at a multiple of 2^k
// have one in each of 2^k equal parts of the time. A pure function of seed and pass.
double pass_time(const Shutter& shutter, std::uint64_t seed, std::uint64_t pass);

} // namespace sundog
