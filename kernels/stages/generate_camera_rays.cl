// Starts camera paths. Reads the camera and the pixel filter; writes rays, paths, the list of active paths,
// and zero radiance. One work-item a pixel of the crop. Used by every method.
#include "math/sampler.h"
#include "scene/camera_rays.h"
#include "shared/path.h"

__kernel void generate_camera_rays(Camera camera, __global const PixelFilter* restrict filter, SamplerKey key, uint count, __global Ray* restrict rays,
                                   __global PathState* restrict paths, __global Vec3* restrict radiance, __global uint* restrict active)
{
    const uint path = get_global_id(0);
    if (path >= count) return;

    const uint2 pixel = pixel_of_path(path, camera.crop_width, camera.crop_height);
    Sampler sampler = camera_sampler(key, path, 0u);
    const float4 u = next_4d(&sampler);
    const float2 x = sample_filter(filter, u.x);
    const float2 y = sample_filter(filter, u.y);
    const float2 corner = (float2)((float)(camera.crop_x + (int)pixel.x), (float)(camera.crop_y + (int)pixel.y));
    rays[path] = camera_ray(&camera, corner + 0.5f + (float2)(x.x, y.x), u.zw);

    const float weight = x.y * y.y;
    PathState state = {{weight, weight, weight}, PDF_DELTA, 1u, 0u, 1.0f, 0u};
    paths[path] = state;
    radiance[path] = pack((float3)(0.0f));
    active[path] = path;
}
