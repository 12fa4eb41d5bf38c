// Adds what camera paths bring, as one number each, to contributions. Reads radiance. One work-item a path. Used by pssmlt.
#include "math/scalar_contribution.h"
#include "math/vec3.h"

__kernel void add_camera_contributions(__global const Vec3* restrict radiance, uint count, __global float* restrict contributions)
{
    const uint path = get_global_id(0);
    if (path < count) contributions[path] += scalar_contribution(unpack(radiance[path]));
}
