// Merges camera vertices with the photons within the radius [Georgiev et al. 2012, eq. 5], each weighted against all other ways
// to make the path. Reads flags, vertices, cell ends, photon streams and what the photons bring for their weights (two streams);
// updates radiance. One work-item an active path. -D DENSITY_KERNEL; the weights are those of the uniform one. Used by the
// bidirectional methods.
#include "density/kernels.h"
#include "density/photon_grid.h"
#include "density/wanted_photons.h"
#include "math/simd8.h"
#include "scene/path_vertex.h"

// The query of a vertex, for what decides which photons count.
static inline GatherQuery vertex_query(__global const PathVertex* vertex, const Surface* surface, const Scattering* scattering,
                                       PathRules rules, float radius)
{
    GatherQuery query;
    query.position = vertex->position;
    query.radius = radius;
    query.max_photon_depth = rules.max_depth == UNBOUNDED_DEPTH ? UNBOUNDED_DEPTH : rules.max_depth - vertex->depth;
    query.normal = pack(facing(surface->geometric_normal, surface->outgoing));
    query.flags = is_transmissive(scattering) ? QUERY_BOTH_SIDES : 0u;
    return query;
}

// f times the weight of a merge with a photon that came along `direction`.
static inline float3 merged(const Surface* surface, const Scattering* scattering, PathWeights weights, Techniques techniques,
                            float3 direction, float vcm, float vm)
{
    const float3 f = evaluate_for_photon(scattering, surface, -direction);
    if (is_black(f)) return f;
    const float light_share = merge_share(vcm, vm, techniques, bsdf_pdf_w(scattering, surface, -direction));
    const float camera_share = merge_share(weights.vcm, weights.vm, techniques, bsdf_reverse_pdf_w(scattering, surface, -direction));
    return f * joint_weight(light_share, camera_share);
}

__kernel void merge_photons(PhotonGrid grid, __global const uint* restrict cell_ends, uint cell_ends_offset,
                            __global const float* restrict streams, __global const float* restrict weight_streams, PathRules rules,
                            Techniques techniques, float radius, __global const uint* restrict active,
                            __global const uint* restrict active_count, __global const uint* restrict flags,
                            __global const PathVertex* restrict vertices, __global Vec3* restrict radiance)
{
    const uint item = get_global_id(0);
    if (item >= *active_count || !(flags[item] & PATH_JOINS)) return;
    const uint path = active[item];
    __global const PathVertex* vertex = vertices + path;
    Surface surface;
    const Scattering scattering = scattering_of(vertex, &surface);
    const PathWeights weights = vertex->weights;
    const GatherQuery query = vertex_query(vertex, &surface, &scattering, rules, radius);
    const float inverse_radius_squared = 1.0f / (radius * radius);
    const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);

    PhotonRun runs[8];
    const uint run_count = find_photon_runs(&grid, cell_ends + cell_ends_offset, surface.position, runs);
    float3 sum = (float3)(0.0f);
    for (uint r = 0u; r < run_count; ++r) {
        for (uint i = runs[r].begin; i < runs[r].end; i += 8u) {
            const float8 t_squared = squared_lengths(photon_offsets(streams, grid.stride, i, surface.position)) * inverse_radius_squared;
            int8 mask = (t_squared < 1.0f) & (lane < (int8)((int)(runs[r].end - i)));
            if (!mask8(mask)) continue;
            mask &= wanted(as_uint8(load_stream(streams, PHOTON_NORMAL_DEPTH, grid.stride, i)), &query);
            float shape[8];
            int wanted_lane[8];
            vstore8(kernel_shape(t_squared), 0, shape);
            vstore8(mask, 0, wanted_lane);
            for (uint j = 0u; j < 8u; ++j) {
                if (!wanted_lane[j]) continue;
                const float3 flux = (float3)(streams[PHOTON_RED * grid.stride + i + j], streams[PHOTON_GREEN * grid.stride + i + j],
                                             streams[PHOTON_BLUE * grid.stride + i + j]);
                const float3 direction = unpack_direction(as_uint(streams[PHOTON_DIRECTION * grid.stride + i + j]));
                sum += flux * shape[j] *
                       merged(&surface, &scattering, weights, techniques, direction, weight_streams[i + j],
                              weight_streams[grid.stride + i + j]);
            }
        }
    }
    sum *= unpack(vertex->throughput) * (KERNEL_NORM * inverse_radius_squared / techniques.light_paths);
    radiance[path] = pack(unpack(radiance[path]) + sum);
}
