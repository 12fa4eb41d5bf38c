// Decisions that exact arithmetic takes for a path, and whether rounding may have taken them otherwise.
#pragma once

#include <cmath>

namespace sundog
{

// Float kernels round: where two numbers that a branch compares lie close together, the kernel may rightly go the other
// way, and where a small difference of large numbers decides a result, few of its digits are right. The plain C++ says
// so here as it goes along, and tests leave such items out, and count them.
class Doubt
{
public:
    // Numbers around 1 after some ten operations, each rounded by 6e-8, with room to spare.
    static constexpr double rounding = 1e-5;

    // a < b.
    bool less(double a, double b, double margin = rounding)
    {
        close_ = close_ || std::abs(a - b) <= margin;
        return a < b;
    }
    bool positive(double a, double margin = rounding) { return less(0.0, a, margin); }

    // The result rests on a number that has too few right digits below `least`.
    void rests_on(double number, double least) { ill_conditioned_ = ill_conditioned_ || std::abs(number) < least; }

    explicit operator bool() const { return close_ || ill_conditioned_; }

private:
    bool close_ = false;
    bool ill_conditioned_ = false;
};

} // namespace sundog
