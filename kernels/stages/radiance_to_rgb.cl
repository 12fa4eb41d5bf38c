// Turns radiance at the pass's wavelengths into linear sRGB. Updates radiance. One work-item a pixel. Used by every method
// in spectral transport.
#include "math/matrix3.h"
#include "shared/scene_arrays.h"

__kernel void radiance_to_rgb(__global const SceneGlobals* restrict globals, uint count, __global Vec3* restrict radiance)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    radiance[index] = pack(rows_times(globals->wavelengths.to_rgb, unpack(radiance[index])));
}
