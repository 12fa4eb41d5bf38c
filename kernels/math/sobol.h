// The first four Sobol dimensions, Owen-scrambled by hashing.
#ifndef SUNDOG_SOBOL_H
#define SUNDOG_SOBOL_H
#include "math/hash.h"

// Direction numbers of [Joe and Kuo 2008], dimensions 1 to 4, with the bits of each word reversed
// (the scrambling below works on reversed words). Row i belongs to bit i of the index.
__constant const uint SOBOL_DIRECTIONS[32][4] = {
    {0x00000001u, 0x00000001u, 0x00000001u, 0x00000001u},
    {0x00000002u, 0x00000003u, 0x00000003u, 0x00000003u},
    {0x00000004u, 0x00000005u, 0x00000006u, 0x00000004u},
    {0x00000008u, 0x0000000fu, 0x00000009u, 0x0000000au},
    {0x00000010u, 0x00000011u, 0x00000017u, 0x0000001fu},
    {0x00000020u, 0x00000033u, 0x0000003au, 0x0000002eu},
    {0x00000040u, 0x00000055u, 0x00000071u, 0x00000045u},
    {0x00000080u, 0x000000ffu, 0x000000a3u, 0x000000c9u},
    {0x00000100u, 0x00000101u, 0x00000116u, 0x0000011bu},
    {0x00000200u, 0x00000303u, 0x00000339u, 0x000002a4u},
    {0x00000400u, 0x00000505u, 0x00000677u, 0x0000079au},
    {0x00000800u, 0x00000f0fu, 0x000009aau, 0x00000b67u},
    {0x00001000u, 0x00001111u, 0x00001601u, 0x0000101eu},
    {0x00002000u, 0x00003333u, 0x00003903u, 0x0000302du},
    {0x00004000u, 0x00005555u, 0x00007706u, 0x00004041u},
    {0x00008000u, 0x0000ffffu, 0x0000aa09u, 0x0000a0c3u},
    {0x00010000u, 0x00010001u, 0x00010117u, 0x0001f104u},
    {0x00020000u, 0x00030003u, 0x0003033au, 0x0002e28au},
    {0x00040000u, 0x00050005u, 0x00060671u, 0x000457dfu},
    {0x00080000u, 0x000f000fu, 0x000909a3u, 0x000c9baeu},
    {0x00100000u, 0x00110011u, 0x00171616u, 0x0011a105u},
    {0x00200000u, 0x00330033u, 0x003a3939u, 0x002a7289u},
    {0x00400000u, 0x00550055u, 0x00717777u, 0x0079e7dbu},
    {0x00800000u, 0x00ff00ffu, 0x00a3aaaau, 0x00b6dba4u},
    {0x01000000u, 0x01010101u, 0x01170001u, 0x0100011au},
    {0x02000000u, 0x03030303u, 0x033a0003u, 0x030002a7u},
    {0x04000000u, 0x05050505u, 0x06710006u, 0x0400079eu},
    {0x08000000u, 0x0f0f0f0fu, 0x09a30009u, 0x0a000b6du},
    {0x10000000u, 0x11111111u, 0x16160017u, 0x1f001001u},
    {0x20000000u, 0x33333333u, 0x3939003au, 0x2e003003u},
    {0x40000000u, 0x55555555u, 0x77770071u, 0x45004004u},
    {0x80000000u, 0xffffffffu, 0xaaaa00a3u, 0xc900a00au},
};

// Owen scrambling of a bit-reversed word: a hash in which each bit depends on lower bits only
// [Laine and Karras 2011], with the constants of [Vegdahl 2021].
inline uint4 scramble_reversed(uint4 x, uint4 seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

inline uint4 reverse_bits(uint4 x)
{
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

// Point `index` of the scrambled, shuffled 4-D sequence that `seed` names, in [0,1)^4. Different
// seeds give independently scrambled sequences, to be padded into more dimensions
// [Burley 2020, Practical Hash-based Owen Scrambling].
inline float4 sobol_owen_4d(uint index, uint seed)
{
    const uint shuffled = scramble_reversed(reverse_bits((uint4)(index)), (uint4)(hash_uint(seed))).x;
    uint4 x = (uint4)(0u);
    for (uint bit = 0u; bit < 32u; ++bit) {
        // `shuffled` is reversed too: its top bit is the index's lowest.
        const uint mask = 0u - ((shuffled >> (31u - bit)) & 1u);
        x ^= vload4(bit, &SOBOL_DIRECTIONS[0][0]) & mask;
    }
    const uint4 seeds = (uint4)(hash_uint(seed ^ 0x9e3779b9u), hash_uint(seed ^ 0x7f4a7c15u), hash_uint(seed ^ 0xf39cc060u), hash_uint(seed ^ 0x5cedc834u));
    x = reverse_bits(scramble_reversed(x, seeds));
    return convert_float4(x >> 8) * 0x1p-24f;
}

#endif
