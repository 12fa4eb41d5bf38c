// Takes over the splats of light subpaths, in their order. Reads lens_splats and the path of each; writes splats from first_splat on,
// times scale, each marked as of sample first_sample + path. One work-item a splat. Used by pssmlt.
#include "math/vec3.h"
#include "shared/film.h"

__kernel void leave_light_splats(__global const Splat* restrict lens_splats, __global const uint* restrict owners, uint count, float scale,
                                 uint first_splat, uint first_sample, __global Splat* restrict splats, __global uint* restrict samples)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    Splat splat = lens_splats[i];
    splat.radiance = pack(unpack(splat.radiance) * scale);
    splats[first_splat + i] = splat;
    samples[first_splat + i] = first_sample + owners[i];
}
