// How the cone of path space regularization narrows [Kaplanyan and Dachsbacher 2013, section 5].
#pragma once

#include "methods/parameters.h"
#include "shared/regularization.h"

#include <cstdint>

namespace sundog
{

// gamma_i = gamma_1 i^-rate. The variance of a vertex mollified in two dimensions goes as gamma^-2, its bias as gamma^2: of
// the mean of N iterations, variance N^(2 rate - 1) and squared bias N^(-4 rate) fall alike at the rate 1/6, as N^(-2/3).
class RegularizationSchedule
{
public:
    explicit RegularizationSchedule(const Parameters& parameters);

    Regularization at(std::uint64_t iteration) const; // from 0

    static std::vector<ParameterSpec> specs();

private:
    double first_angle_, rate_; // angle in radians
};

} // namespace sundog
