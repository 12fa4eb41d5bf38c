// Starts camera paths anywhere on the film: which pixel, and where within its filter, is for the path's numbers to say. Reads the
// camera and the pixel filter; writes rays, paths, each path's pixel, the list of active paths, and zero radiance. One work-item a
// path. Used by methods that drive paths by Markov chains.
#include "math/sampler.h"
#include "scene/camera_rays.h"
#include "shared/path.h"

__kernel void generate_film_rays(Camera camera, __global const PixelFilter* restrict filter, SAMPLER_PARAMETERS, uint count,
                                 __global Ray* restrict rays, __global PathState* restrict paths, __global Vec3* restrict radiance,
                                 __global uint* restrict active, __global uint* restrict pixels)
{
    const uint path = get_global_id(0);
    if (path >= count) return;

    Sampler sampler = camera_sampler(SAMPLER_VIEW, path, 0u);
    const uint4 words = next_words(&sampler);
    const float2 lens = unit_float4(words).zw;
    // Whole and fraction of word x size / 2^32.
    const uint2 size = (uint2)((uint)camera.crop_width, (uint)camera.crop_height);
    const uint2 pixel = mul_hi(words.xy, size);
    const uint2 within = words.xy * size;
    const float2 x = sample_filter(filter, unit_float(within.x));
    const float2 y = sample_filter(filter, unit_float(within.y));
    const float2 corner = (float2)((float)(camera.crop_x + (int)pixel.x), (float)(camera.crop_y + (int)pixel.y));
    rays[path] = camera_ray(&camera, corner + 0.5f + (float2)(x.x, y.x), lens);

    const float weight = x.y * y.y;
    PathState state = {{weight, weight, weight}, PDF_DELTA, 1u, 0u, 1.0f, 0u};
    paths[path] = state;
    radiance[path] = pack((float3)(0.0f));
    active[path] = path;
    pixels[path] = path_of_pixel(pixel, size.x, size.y);
}
