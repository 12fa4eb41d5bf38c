// Merges camera vertices with the photons within the radius [Georgiev et al. 2012, eq. 5], each weighted against all other
// ways to make the path. Reads flags, vertices, cell ends, photon streams and what the photons bring for their weights (two
// streams); updates radiance. One work-item an active path; eight photons at a time. -D DENSITY_KERNEL; the weights are those
// of the uniform one. Used by the bidirectional methods.
#include "density/kernels.h"
#include "density/photon_lanes.h"
#include "density/wanted_photons.h"
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

// What eight photons bring to a merge.
typedef struct MergedPhotons8 {
    Flux8 flux;
    uint8 directions; // of propagation, packed
    float8 vcm, vm;
} MergedPhotons8;

static inline MergedPhotons8 load_photons(const PhotonMap* map, __global const float* weight_streams, uint i)
{
    MergedPhotons8 photons;
    photons.flux = load_flux(map, i);
    photons.directions = as_uint8(load_stream(map, PHOTON_DIRECTION, i));
    photons.vcm = vload8(0, weight_streams + i);
    photons.vm = vload8(0, weight_streams + map->grid.stride + i);
    return photons;
}

static inline void add_lanes(Flux8* sum, int8 mask, float8 factor, Flux8 flux)
{
    sum->red += as_float8(mask & as_int8(factor * flux.red));
    sum->green += as_float8(mask & as_int8(factor * flux.green));
    sum->blue += as_float8(mask & as_int8(factor * flux.blue));
}

// A diffuse lobe, whose f all photons share, and whose densities are cosines.
static inline void merge_diffuse(const MergingVertex* vertex, Techniques techniques, int8 mask, float8 shape, MergedPhotons8 photons, Flux8* sum)
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
static inline void merge_one_by_one(const MergingVertex* vertex, Techniques techniques, int8 mask, float8 shape, MergedPhotons8 photons,
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

typedef struct Merging {
    float3 position;
    float inverse_radius_squared;
    const MergingVertex* vertex;
    const Techniques* techniques;
    __global const float* weight_streams;
    bool diffuse;
    Flux8 sum;
} Merging;
#define VISITOR Merging

// Squares are shares of the radius'.
static inline int8 visitor_reach(const Merging* merging, Offset8 offset, float8* squares)
{
    *squares = squared_lengths(offset) * merging->inverse_radius_squared;
    return *squares < 1.0f;
}

static inline Merging visit(Merging merging, const PhotonMap* map, Photons8 near)
{
    const int8 mask = near.mask & wanted(as_uint8(load_stream(map, PHOTON_NORMAL_DEPTH, near.first)), &merging.vertex->query);
    const MergedPhotons8 photons = load_photons(map, merging.weight_streams, near.first);
    const float8 shape = kernel_shape(near.squares);
    if (merging.diffuse) merge_diffuse(merging.vertex, *merging.techniques, mask, shape, photons, &merging.sum);
    else merge_one_by_one(merging.vertex, *merging.techniques, mask, shape, photons, &merging.sum);
    return merging;
}

#include "density/visit_photons.h"

__kernel void merge_photons(MAP_PARAMETERS, __global const float* restrict weight_streams, PathRules rules, Techniques techniques, float radius,
                            __global const uint* restrict active, __global const uint* restrict active_count, __global const uint* restrict flags,
                            __global const PathVertex* restrict vertices, __global Vec3* restrict radiance)
{
    const uint item = get_global_id(0);
    if (item >= *active_count || !(flags[item] & PATH_JOINS)) return;
    const uint path = active[item];
    const PhotonMap map = MAP_VIEW;
    const MergingVertex vertex = merging_vertex(vertices + path, rules, radius);
    const bool diffuse = vertex.scattering.lobe == LOBE_DIFFUSE && !(vertex.scattering.flags & LOBE_CHANGED);
    const float inverse_radius_squared = 1.0f / (radius * radius);
    Merging merging = {vertex.surface.position, inverse_radius_squared, &vertex, &techniques, weight_streams, diffuse,
                       {(float8)(0.0f), (float8)(0.0f), (float8)(0.0f)}};
    merging = visit_photons(merging, &map);
    const float3 f = diffuse ? evaluate_diffuse(&vertex.scattering) : (float3)(1.0f);
    const float3 flux = (float3)(sum8(merging.sum.red), sum8(merging.sum.green), sum8(merging.sum.blue));
    const float3 irradiance = flux * (KERNEL_NORM * inverse_radius_squared / techniques.light_paths);
    radiance[path] = pack(unpack(radiance[path]) + unpack(vertices[path].throughput) * f * irradiance);
}
