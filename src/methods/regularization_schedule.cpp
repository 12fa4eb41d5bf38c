#include "methods/regularization_schedule.h"

#include <cmath>
#include <numbers>

namespace sundog
{

RegularizationSchedule::RegularizationSchedule(const Parameters& parameters)
    : first_angle_(parameters.real("angle") * std::numbers::pi / 180.0), rate_(parameters.real("rate"))
{
}

Regularization RegularizationSchedule::at(std::uint64_t iteration) const
{
    const double angle = first_angle_ * std::pow(static_cast<double>(iteration + 1), -rate_);
    const double half_sine = std::sin(0.5 * angle);
    const double one_minus_cos = 2.0 * half_sine * half_sine;
    return {static_cast<float>(one_minus_cos), static_cast<float>(0.5 * std::numbers::inv_pi / one_minus_cos)};
}

std::vector<ParameterSpec> RegularizationSchedule::specs()
{
    return {{"angle", ParameterType::real, "3", "degrees",
             "Half angle of the cone within which a specular direction counts as that to a light, in the first iteration.", 0.001, 90.0, {}},
            {"rate", ParameterType::real, "0.1666667", "",
             "How fast the cone narrows: its angle in iteration i is that of the first times i^-rate. 1/6 balances noise and bias, 0 keeps it.", 0.0,
             0.25, {}}};
}

} // namespace sundog
