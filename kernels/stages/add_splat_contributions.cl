// Adds what a bounce's splats count for to their paths' contributions. Reads deposits and flags; updates contributions. One
// work-item an active path. Used by pssmlt.
#include "math/scalar_contribution.h"
#include "math/vec3.h"
#include "shared/film.h"
#include "shared/path.h"

__kernel void add_splat_contributions(__global const Splat* restrict deposits, __global const uint* restrict flags,
                                      __global const uint* restrict active, __global const uint* restrict active_count, float scale,
                                      __global float* restrict contributions)
{
    const uint item = get_global_id(0);
    if (item >= *active_count || !(flags[item] & PATH_DEPOSIT)) return;
    contributions[active[item]] += scale * scalar_contribution(unpack(deposits[item].radiance));
}
