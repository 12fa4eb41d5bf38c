// Turns what queries found at the pass's wavelengths into linear sRGB, so that statistics over passes, whose wavelengths
// differ, can add it up. Updates sums, to throughput times sum in sRGB, and queries, whose throughput becomes 1. One
// work-item a query. Used by sppm in spectral transport.
#include "math/matrix3.h"
#include "shared/photon.h"
#include "shared/scene_arrays.h"

__kernel void gathered_to_rgb(__global const SceneGlobals* restrict globals, uint count, __global GatherQuery* restrict queries, __global GatherSum* restrict sums)
{
    const uint index = get_global_id(0);
    if (index >= count || queries[index].radius == 0.0f) return;
    const float3 found = unpack(queries[index].throughput) * unpack(sums[index].flux);
    sums[index].flux = pack(rows_times(globals->wavelengths.to_rgb, found));
    queries[index].throughput = pack((float3)(1.0f));
}
