// Student's t distribution: how many standard errors a mean of few samples may be off.
#pragma once

namespace sundog
{

// Probability that a t variable of `degrees` > 0 degrees of freedom exceeds t >= 0 [Abramowitz and Stegun 1964,
// eq. 26.7.1: half the incomplete beta function I_x(degrees / 2, 1 / 2) at x = degrees / (degrees + t^2)].
double student_t_tail(double t, double degrees);

// The t that is exceeded with the given probability, in (0, 1/2].
double student_t_quantile(double tail, double degrees);

} // namespace sundog
