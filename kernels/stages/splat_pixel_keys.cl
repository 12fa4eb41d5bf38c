// Each splat's pixel. Reads splats; writes keys to sort them by. One work-item a splat. Used by
// ptracer, the bidirectional methods and pssmlt.
#include "shared/film.h"

__kernel void splat_pixel_keys(__global const Splat* restrict splats, __global const uint* restrict splat_count, __global uint* restrict keys)
{
    const uint i = get_global_id(0);
    if (i < *splat_count) keys[i] = splats[i].pixel;
}
