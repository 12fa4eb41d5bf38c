// Marks the splats whose shadow ray was free as deposits. Reads occluded; updates flags. One work-item an
// active path. Used by ptracer.
#include "shared/path.h"

__kernel void flag_unoccluded(__global const uint* restrict active, __global const uint* restrict active_count, __global const uint* restrict occluded,
                              __global uint* restrict flags)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    if (!occluded[active[item]]) flags[item] |= PATH_DEPOSIT;
}
