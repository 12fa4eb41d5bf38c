// Philox4x32-10, a counter-based generator [Salmon et al. 2011, Parallel Random Numbers: As Easy as 1, 2, 3].
#ifndef SUNDOG_PHILOX_H
#define SUNDOG_PHILOX_H

static inline uint4 philox4x32(uint4 counter, uint2 key)
{
    for (int round = 0; round < 10; ++round) {
        const uint high0 = mul_hi(0xd2511f53u, counter.x), low0 = 0xd2511f53u * counter.x;
        const uint high1 = mul_hi(0xcd9e8d57u, counter.z), low1 = 0xcd9e8d57u * counter.z;
        counter = (uint4)(high1 ^ counter.y ^ key.x, low1, high0 ^ counter.w ^ key.y, low0);
        key += (uint2)(0x9e3779b9u, 0xbb67ae85u);
    }
    return counter;
}

#endif
