// 3 x 3 matrices in global memory, a row after the other.
#ifndef SUNDOG_MATRIX3_H
#define SUNDOG_MATRIX3_H
#include "math/vec3.h"

static inline float3 rows_times(__global const Vec3* rows, float3 v)
{
    return (float3)(dot(unpack(rows[0]), v), dot(unpack(rows[1]), v), dot(unpack(rows[2]), v));
}

#endif
