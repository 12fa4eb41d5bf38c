// Merges camera vertices with the photons within the radius [Georgiev et al. 2012, eq. 5], each weighted against all other
// ways to make the path. Reads flags, vertices, cell ends, photon streams and what the photons bring for their weights (two
// streams); updates radiance. One work-item an active path; eight photons at a time. -D DENSITY_KERNEL; the weights are those
// of the uniform one. Used by the bidirectional methods.
#include "density/flux8.h"
#include "density/kernels.h"
#include "density/photon_grid.h"
#include "density/wanted_photons.h"
#include "math/simd8.h"
#include "math/sum8.h"
#include "scene/path_vertex.h"

// A camera vertex, and which photons it asks for.
typedef struct MergingVertex {
    Surface surface;
    Scattering scattering;
    PathWeights weights;
    GatherQuery query;
} MergingVertex;

static inline MergingVertex merging_vertex(__global const PathVertex* vertex, PathRules rules, float radius)
{
    MergingVertex merging;
    merging.scattering = scattering_of(vertex, &merging.surface);
    merging.weights = vertex->weights;
    merging.query.position = vertex->position;
    merging.query.radius = radius;
    merging.query.max_photon_depth = rules.max_depth == UNBOUNDED_DEPTH ? UNBOUNDED_DEPTH : rules.max_depth - vertex->depth;
    merging.query.normal = pack(facing(merging.surface.geometric_normal, merging.surface.outgoing));
    merging.query.flags = is_transmissive(&merging.scattering) ? QUERY_BOTH_SIDES : 0u;
    return merging;
}

typedef struct Photons8 {
    Flux8 flux;
    uint8 directions; // of propagation, packed
    float8 vcm, vm;
} Photons8;

static inline Photons8 load_photons(__global const float* streams, __global const float* weight_streams, uint stride, uint i)
{
    Photons8 photons;
    photons.flux.red = load_stream(streams, PHOTON_RED, stride, i);
    photons.flux.green = load_stream(streams, PHOTON_GREEN, stride, i);
    photons.flux.blue = load_stream(streams, PHOTON_BLUE, stride, i);
    photons.directions = as_uint8(load_stream(streams, PHOTON_DIRECTION, stride, i));
    photons.vcm = load_stream(weight_streams, 0u, stride, i);
    photons.vm = load_stream(weight_streams, 1u, stride, i);
    return photons;
}

static inline void add_lanes(Flux8* sum, int8 mask, float8 factor, Flux8 flux)
{
    sum->red += as_float8(mask & as_int8(factor * flux.red));
    sum->green += as_float8(mask & as_int8(factor * flux.green));
    sum->blue += as_float8(mask & as_int8(factor * flux.blue));
}

// A diffuse lobe, whose f all photons share, and whose densities are cosines.
static inline void merge_diffuse(const MergingVertex* vertex, Techniques techniques, int8 mask, float8 shape, Photons8 photons, Flux8* sum)
{
    const Offset8 direction = unpack_directions(photons.directions);
    const float3 n = -vertex->scattering.normal;
    const float3 face = -facing(vertex->surface.geometric_normal, vertex->surface.outgoing);
    const float8 cosine = direction.x * n.x + direction.y * n.y + direction.z * n.z;
    mask &= (cosine > 0.0f) & (direction.x * face.x + direction.y * face.y + direction.z * face.z >= 0.0f);
    const float8 light_share = photons.vcm * techniques.inverse_merge + cosine * INV_PI_F * photons.vm; // as merge_share
    const float camera_share = merge_share(vertex->weights.vcm, vertex->weights.vm, techniques, diffuse_pdf_w(vertex->scattering.cos_o));
    add_lanes(sum, mask, shape / (1.0f + camera_share + light_share), photons.flux);
}

// f of any lobe for a photon, times the weight of the merge.
static inline float3 merged(const MergingVertex* vertex, Techniques techniques, float3 incoming, float vcm, float vm)
{
    const float3 f = evaluate_for_photon(&vertex->scattering, &vertex->surface, incoming);
    if (is_black(f)) return f;
    const BsdfDensities densities = bsdf_densities(&vertex->scattering, &vertex->surface, incoming);
    const float light_share = merge_share(vcm, vm, techniques, densities.pdf_w);
    const float camera_share = merge_share(vertex->weights.vcm, vertex->weights.vm, techniques, densities.reverse_pdf_w);
    return f * joint_weight(light_share, camera_share);
}

// Any lobe: one photon after another.
static inline void merge_one_by_one(const MergingVertex* vertex, Techniques techniques, int8 mask, float8 shape, Photons8 photons,
                                    Flux8* sum)
{
    float red[8], green[8], blue[8], vcm[8], vm[8];
    uint direction[8];
    int wanted_lane[8];
    vstore8(photons.vcm, 0, vcm);
    vstore8(photons.vm, 0, vm);
    vstore8(photons.directions, 0, direction);
    vstore8(mask, 0, wanted_lane);
    for (int i = 0; i < 8; ++i) {
        const float3 f = wanted_lane[i] ? merged(vertex, techniques, -unpack_direction(direction[i]), vcm[i], vm[i]) : (float3)(0.0f);
        red[i] = f.x;
        green[i] = f.y;
        blue[i] = f.z;
    }
    const Flux8 scattered = {photons.flux.red * vload8(0, red), photons.flux.green * vload8(0, green), photons.flux.blue * vload8(0, blue)};
    add_lanes(sum, mask, shape, scattered);
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
    const MergingVertex vertex = merging_vertex(vertices + path, rules, radius);
    const bool diffuse = vertex.scattering.lobe == LOBE_DIFFUSE && !(vertex.scattering.flags & LOBE_CHANGED);
    const float inverse_radius_squared = 1.0f / (radius * radius);
    const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);

    PhotonRun runs[8];
    const uint run_count = find_photon_runs(&grid, cell_ends + cell_ends_offset, vertex.surface.position, runs);
    Flux8 sum = {(float8)(0.0f), (float8)(0.0f), (float8)(0.0f)};
    for (uint r = 0u; r < run_count; ++r) {
        for (uint i = runs[r].begin; i < runs[r].end; i += 8u) {
            const float8 t_squared =
                squared_lengths(photon_offsets(streams, grid.stride, i, vertex.surface.position)) * inverse_radius_squared;
            int8 mask = (t_squared < 1.0f) & (lane < (int8)((int)(runs[r].end - i)));
            if (!mask8(mask)) continue;
            mask &= wanted(as_uint8(load_stream(streams, PHOTON_NORMAL_DEPTH, grid.stride, i)), &vertex.query);
            const Photons8 photons = load_photons(streams, weight_streams, grid.stride, i);
            if (diffuse)
                merge_diffuse(&vertex, techniques, mask, kernel_shape(t_squared), photons, &sum);
            else
                merge_one_by_one(&vertex, techniques, mask, kernel_shape(t_squared), photons, &sum);
        }
    }
    const float3 f = diffuse ? evaluate_diffuse(&vertex.scattering) : (float3)(1.0f);
    const float3 flux = (float3)(sum8(sum.red), sum8(sum.green), sum8(sum.blue));
    const float3 irradiance = flux * (KERNEL_NORM * inverse_radius_squared / techniques.light_paths);
    radiance[path] = pack(unpack(radiance[path]) + unpack(vertices[path].throughput) * f * irradiance);
}
