// Sums that keep their rounding errors.
#ifndef SUNDOG_COMPENSATED_H
#define SUNDOG_COMPENSATED_H
#include "math/vec3.h"

// Adds x to the sum (*sum + *error), exactly but for second-order rounding [Neumaier 1974].
static inline void add_compensated(float* sum, float* error, float x)
{
#pragma OPENCL FP_CONTRACT OFF
    const float total = *sum + x;
    *error += fabs(*sum) >= fabs(x) ? (*sum - total) + x : (x - total) + *sum;
    *sum = total;
}

static inline void add_compensated3(Vec3* sum, Vec3* error, float3 x)
{
    add_compensated(&sum->x, &error->x, x.x);
    add_compensated(&sum->y, &error->y, x.y);
    add_compensated(&sum->z, &error->z, x.z);
}

// The same for x^2, whose own rounding error would else hide a variance of less than 2^-24 x^2.
static inline void add_square_compensated(float* sum, float* error, float x)
{
#pragma OPENCL FP_CONTRACT OFF
    const float square = x * x;
    add_compensated(sum, error, square);
    *error += fma(x, x, -square);
}

static inline void add_squares_compensated3(Vec3* sum, Vec3* error, float3 x)
{
    add_square_compensated(&sum->x, &error->x, x.x);
    add_square_compensated(&sum->y, &error->y, x.y);
    add_square_compensated(&sum->z, &error->z, x.z);
}

#endif
