// Marks the splats whose shadow ray was free as deposits. Reads occluded; writes flags. One work-item an
// active path. Used by ptracer and the bidirectional methods.
#include "shared/path.h"

__kernel void flag_unoccluded(__global const uint* restrict active, __global const uint* restrict active_count, __global const uint* restrict occluded,
                              __global uint* restrict flags)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    flags[item] = occluded[active[item]] ? PATH_ENDED : PATH_DEPOSIT;
}
