// Sum of a vector's eight lanes.
#ifndef SUNDOG_SUM8_H
#define SUNDOG_SUM8_H

static inline float sum8(float8 v)
{
    const float4 a = v.lo + v.hi;
    return (a.x + a.z) + (a.y + a.w);
}

#endif
