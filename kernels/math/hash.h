// Integer hashing.
#ifndef SUNDOG_HASH_H
#define SUNDOG_HASH_H

// A bijection of 32-bit words with low bias [Wellons 2018, "lowbias32"].
static inline uint hash_uint(uint x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

static inline uint4 hash_uint4(uint4 x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

// The upper 24 bits of each word as a number in [0, 1).
static inline float4 unit_float4(uint4 x) { return convert_float4(as_int4(x >> 8)) * 0x1p-24f; }

static inline float unit_float(uint x) { return (float)(x >> 8) * 0x1p-24f; }

static inline uint hash_combine(uint seed, uint value) { return hash_uint(seed ^ (value + 0x9e3779b9u + (seed << 6) + (seed >> 2))); }

#endif
