// Gives each query its pixel's radius. Reads the pixels' statistics, whose type is -D PIXEL_STATISTICS; updates
// queries. One work-item a query. Used where radii are local.
#include "shared/adaptive_radius.h"
#include "shared/binned_photons.h"
#include "shared/counted_radius.h"
#include "shared/film.h"
#include "shared/photon.h"

__kernel void set_query_radii(__global const PIXEL_STATISTICS* restrict pixels, uint count, __global GatherQuery* restrict queries)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    if (queries[index].radius > 0.0f) queries[index].radius = sqrt(pixels[index].radius_squared);
}
