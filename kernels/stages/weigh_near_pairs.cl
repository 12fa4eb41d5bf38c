// What connecting to a light vertex brings, where the vertex was found by coming near it: a connection's weight is to be multiplied by the
// ratio of the densities that weights have for either technique, which is pi r^2 p(y|x), and by 1 / P [Qin et al. 2015, eq. 9]. Reads
// pairs, vertices and states; updates radiance. One work-item a pair. Used by upg.
#include "scene/trial_cone.h"
#include "shared/trials.h"

__kernel void weigh_near_pairs(float radius, uint count, __global const VertexPair* restrict pairs,
                               __global const PathVertex* restrict camera_vertices, __global const PathVertex* restrict light_vertices,
                               __global const TrialState* restrict states, __global Vec3* restrict radiance)
{
    const uint item = get_global_id(0);
    if (item >= count) return;
    const TrialState state = states[item];
    if (state.count == 0u) return;
    Surface surface, lit;
    const Scattering scattering = scattering_of(camera_vertices + pairs[item].path, &surface);
    scattering_of(light_vertices + pairs[item].slot, &lit);
    const float3 between = lit.position - surface.position;
    const float distance_squared = dot(between, between);
    const float3 direction = between * rsqrt(distance_squared);
    const float pdf_a = bsdf_pdf_w(&scattering, &surface, direction) * fabs(dot(direction, lit.geometric_normal)) / distance_squared;
    const TrialCone cone = bounding_cone(&surface, lit.position, radius);
    const float reciprocal = state.bound > 0.0f ? state.sum / cone.solid_angle : state.sum;
    radiance[item] = pack(unpack(radiance[item]) * (PI_F * radius * radius * pdf_a * reciprocal));
}
