// Connects camera vertices to light vertices. Reads pairs; writes for each the shadow ray between its vertices and the radiance that it
// brings if that is free, weighted against all other ways to make the path. One work-item a pair. Used by the bidirectional methods.
#include "math/simd8.h"
#include "scene/continue_path.h"
#include "scene/lights.h"
#include "scene/path_vertex.h"

// Light vertices lie bounce by bounce: memory would be waited for at each.
#define PAIRS_AHEAD 8u

__kernel void connect_vertices(PathRules rules, float scale, uint count,
                               __global const VertexPair* restrict pairs, __global const PathVertex* restrict camera_vertices,
                               __global const PathVertex* restrict light_vertices, __global Ray* restrict shadow_rays,
                               __global Vec3* restrict radiance)
{
    const uint item = get_global_id(0);
    if (item >= count) return;
    shadow_rays[item].t_max = 0.0f;
    const VertexPair pair = pairs[item];
    const uint soon = pairs[min(item + PAIRS_AHEAD, count - 1u)].slot;
    if (soon != NO_VERTEX) prefetch_lines(light_vertices + soon, VERTEX_LINES);
    if (pair.slot == NO_VERTEX) return;
    __global const PathVertex* camera_vertex = camera_vertices + pair.path;
    __global const PathVertex* light_vertex = light_vertices + pair.slot;
    const uint edges = camera_vertex->depth + light_vertex->depth + 1u;
    if (edges > rules.max_depth) return;
    const float3 between = unpack(light_vertex->position) - unpack(camera_vertex->position);
    const float distance_squared = dot(between, between);
    const float3 direction = between * rsqrt(distance_squared);
    if (!(distance_squared > 0.0f)) return;

    Surface seen, lit;
    const Scattering at_camera = scattering_of(camera_vertex, &seen);
    const float3 f_camera = bsdf_evaluate(&at_camera, &seen, direction, CARRIES_RADIANCE);
    if (is_black(f_camera)) return;
    const Scattering at_light = scattering_of(light_vertex, &lit);
    const float3 f_light = bsdf_evaluate(&at_light, &lit, -direction, CARRIES_FLUX);
    if (is_black(f_light)) return;

    const float cos_seen = fabs(dot(direction, seen.geometric_normal)), cos_lit = fabs(dot(direction, lit.geometric_normal));
    const float3 value = unpack(camera_vertex->throughput) * f_camera * unpack(light_vertex->throughput) * f_light *
                         (fabs(dot(direction, at_camera.normal)) * cos_lit / distance_squared);
    const BsdfDensities from_camera = bsdf_densities(&at_camera, &seen, direction), from_light = bsdf_densities(&at_light, &lit, -direction);
    const float light_share = connection_share(light_vertex->weights, light_vertex->merge, from_camera.pdf_w * cos_lit / distance_squared,
                                               from_light.reverse_pdf_w);
    const float camera_share = connection_share(camera_vertex->weights, camera_vertex->merge, from_light.pdf_w * cos_seen / distance_squared,
                                                from_camera.reverse_pdf_w);
    radiance[item] = pack(value * (scale * joint_weight(light_share, camera_share)));
    shadow_rays[item] = segment(ray_origin(&seen, direction), ray_origin(&lit, -direction));
}
