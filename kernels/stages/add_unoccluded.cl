// Adds the radiance of next-event estimation where the shadow ray was free. Reads occluded and
// shadow_radiance; updates radiance. One work-item an active path.
#include "math/vec3.h"

__kernel void add_unoccluded(__global const uint* restrict active, __global const uint* restrict active_count, __global const uint* restrict occluded,
                             __global const Vec3* restrict shadow_radiance, __global Vec3* restrict radiance)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint path = active[item];
    if (occluded[path]) return;
    radiance[path] = pack(unpack(radiance[path]) + unpack(shadow_radiance[path]));
}
