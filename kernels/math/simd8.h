// Eight lanes inside one work-item: what OpenCL C lacks for testing eight boxes
// or triangles at a time.
#ifndef SUNDOG_SIMD8_H
#define SUNDOG_SIMD8_H

// Eight vectors.
typedef struct Offset8 {
    float8 x, y, z;
} Offset8;

// Lane-wise minimum and maximum; with a NaN, the second operand. Unlike fmin
// and fmax these are one instruction on a CPU.
static inline float8 min8(float8 a, float8 b)
{
    return a < b ? a : b;
}

static inline float8 max8(float8 a, float8 b)
{
    return a > b ? a : b;
}

// Bit i is set where lane i of a comparison's result is true (all ones).
static inline int mask8(int8 condition)
{
#if defined(__x86_64__) && defined(__AVX__) && !defined(SUNDOG_PORTABLE_SIMD)
    return __builtin_ia32_movmskps256(as_float8(condition));
#else
    const int8 bits = condition & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int4 quarters = bits.lo | bits.hi;
    const int2 halves = quarters.lo | quarters.hi;
    return halves.x | halves.y;
#endif
}

// Index of the lowest set bit of a mask that is not 0 (one instruction on a CPU).
static inline int first_lane(int mask)
{
    return (int)popcount((uint)(~mask & (mask - 1)));
}

// Asks for memory that will be read soon, in lines of 64 bytes. Nothing depends on it.
static inline void prefetch_lines(__global const void* address, uint lines)
{
#if defined(__x86_64__) && !defined(SUNDOG_PORTABLE_SIMD)
    const size_t first = (size_t)address;
#pragma unroll
    for (uint line = 0u; line < lines; ++line) __builtin_prefetch((const void*)(first + 64u * line));
#endif
}

#endif
