// Adds the emission that the camera sees directly: paths of one edge, which a light path cannot connect.
// Reads first hits; updates radiance. One work-item a camera path. Used by ptracer.
#include "scene/direct_light.h"

__kernel void add_visible_light(SURFACE_PARAMETERS, uint count, __global const Ray* restrict rays, __global const Hit* restrict hits,
                                __global const PathState* restrict paths, __global Vec3* restrict radiance)
{
    const uint path = get_global_id(0);
    if (path >= count) return;
    const SurfaceView scene = SURFACE_VIEW;
    float3 emitted = (float3)(0.0f);
    if (hits[path].primitive != NO_PRIMITIVE) {
        const Surface surface = surface_at(&scene, rays[path], hits[path]);
        emitted = emitted_radiance(&scene, &surface, light_of_hit(&scene, &surface));
    } else if (!sees_no_light(rays[path])) {
        emitted = environment_value(&scene, normalize(unpack(rays[path].direction))).radiance;
    }
    radiance[path] = pack(unpack(radiance[path]) + unpack(paths[path].throughput) * emitted);
}
