// Leaves what camera paths that start anywhere on the film bring to it. Reads their radiance and pixels; writes splats at first_splat +
// path, each marked as of sample first_sample + path. One work-item a path. Used by pssmlt.
#include "shared/film.h"

__kernel void leave_camera_splats(__global const Vec3* restrict radiance, __global const uint* restrict pixels, uint count, uint first_splat,
                                  uint first_sample, __global Splat* restrict splats, __global uint* restrict samples)
{
    const uint path = get_global_id(0);
    if (path >= count) return;
    const Splat splat = {radiance[path], pixels[path]};
    splats[first_splat + path] = splat;
    samples[first_splat + path] = first_sample + path;
}
