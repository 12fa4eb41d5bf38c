// Sets radiance to zero. One work-item a pixel. Used by ppm.
#include "math/vec3.h"

__kernel void clear_radiance(uint count, __global Vec3* restrict radiance)
{
    const uint index = get_global_id(0);
    if (index < count) radiance[index] = pack((float3)(0.0f));
}
