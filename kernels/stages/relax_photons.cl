// One sweep of photon relaxation [Spencer and Jones 2009, Computer Graphics Forum 28(2), Into the Blue, section 4]: each photon moves away
// from its -D NEIGHBOURS nearest of the same surface and direction, by the mean of (r - d_k) u_k over them, u_k being the
// unit vector from neighbour k at distance d_k and r the distance of the last. Flux moves with its photon, so none is lost;
// what evens out is noise. Structure stays as far as a photon's neighbours show it:
// - where light grows to one side, the centroid c of the neighbours lies there. A linear gradient g has c = g r^2 / 4 and by
//   the mean above pushes photons down by g r^2 / 12, so that sweeps would blur the light like heat; c / 3 more, and they
//   feel no gradient;
// - where they lie to one side, as at the edge of a caustic or of a surface, it does not move to the other;
// - where they lie along a line, it moves along that alone.
// With -D EQUAL_FLUX=1 [Spencer and Jones 2013, ACM TOG 32(1), Progressive Photon Relaxation] neighbour k pushes with the weight
// 2 - F_k / F, at least 0, F_k being its flux and F the mean of theirs: those that have little push more. A linear gradient g of
// the flux relative to F then moves photons up by g r^2 / 12 a sweep, to where each of them stands for too much light.
// Reads cell ends of a dense grid and photon streams, which hold the positions before the sweep; updates photons. One
// work-item a photon. Used by photonmapper.
#include "density/photon_grid.h"
#include "density/wanted_photons.h"
#include "math/frame.h"
#include "math/luminance.h"
#include "math/simd8.h"
#include "shared/relaxation.h"

// Neighbours whose centroid is further off than this, in r, lie to one side. In even light it is further than c with the
// probability exp(-2 K c^2), 1 in 18: those photons are held back for a sweep.
#define ONE_SIDED (1.2f * rsqrt((float)NEIGHBOURS))
// Their variances along both axes: below this ratio they lie along a line.
#define ALONG_A_LINE 0.2f
// Fewer than this show nothing.
#define LEAST_NEIGHBOURS 4u

#ifndef EQUAL_FLUX
#define EQUAL_FLUX 0
#endif

// In the tangent plane, nearest first.
typedef struct Neighbours {
    uint count;
    float squares[NEIGHBOURS]; // of distances
    float2 offsets[NEIGHBOURS];
#if EQUAL_FLUX
    float flux[NEIGHBOURS]; // luminance of it
#endif
} Neighbours;

static inline void insert_neighbour(Neighbours* neighbours, float square, float2 offset, float flux)
{
    uint place = neighbours->count < NEIGHBOURS ? neighbours->count++ : NEIGHBOURS - 1u;
    for (; place > 0u && neighbours->squares[place - 1u] > square; --place) {
        neighbours->squares[place] = neighbours->squares[place - 1u];
        neighbours->offsets[place] = neighbours->offsets[place - 1u];
#if EQUAL_FLUX
        neighbours->flux[place] = neighbours->flux[place - 1u];
#endif
    }
    neighbours->squares[place] = square;
    neighbours->offsets[place] = offset;
#if EQUAL_FLUX
    neighbours->flux[place] = flux;
#endif
}

// Luminance of a photon's flux; 0 where nobody asks.
static inline float flux_of(__global const float* streams, uint stride, uint place)
{
    if (!EQUAL_FLUX) return 0.0f;
    const float3 flux = (float3)(streams[(size_t)PHOTON_RED * stride + place], streams[(size_t)PHOTON_GREEN * stride + place],
                                 streams[(size_t)PHOTON_BLUE * stride + place]);
    return dot(flux, LUMINANCE_WEIGHTS);
}

// Those nearer than the root of `limit`. Returns the limit for what follows.
static inline float add_neighbours(PhotonRun run, const GatherQuery* self, float3 direction, float least_cosine, Frame frame, __global const float* streams,
                                  uint stride, float limit, Neighbours* neighbours)
{
    const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
    const float3 position = unpack(self->position);
    for (uint i = run.begin; i < run.end; i += 8u) {
        const Offset8 offset = photon_offsets(streams, stride, i, position);
        const float8 squares = squared_lengths(offset);
        int8 mask = (squares < limit) & (squares > 0.0f) & (lane < (int8)((int)(run.end - i))); // itself is at 0
        if (!mask8(mask)) continue;
        mask &= wanted(as_uint8(load_stream(streams, PHOTON_NORMAL_DEPTH, stride, i)), self);
        float distance[8], u[8], v[8];
        vstore8(squares, 0, distance);
        vstore8(offset.x * frame.s.x + offset.y * frame.s.y + offset.z * frame.s.z, 0, u);
        vstore8(offset.x * frame.t.x + offset.y * frame.t.y + offset.z * frame.t.z, 0, v);
        for (int lanes = mask8(mask); lanes != 0; lanes &= lanes - 1) {
            const int k = first_lane(lanes);
            if (!(distance[k] < limit)) continue;
            const uint packed = as_uint(streams[(size_t)PHOTON_DIRECTION * stride + i + (uint)k]);
            if (least_cosine > -1.0f && dot(unpack_direction(packed), direction) < least_cosine) continue;
            insert_neighbour(neighbours, distance[k], (float2)(u[k], v[k]), flux_of(streams, stride, i + (uint)k));
            if (neighbours->count == NEIGHBOURS) limit = neighbours->squares[NEIGHBOURS - 1u];
        }
    }
    return limit;
}

// The axis of a line that they lie along, or 0: by their covariance about the photon.
static inline float2 line_of(const Neighbours* neighbours)
{
    float uu = 0.0f, uv = 0.0f, vv = 0.0f;
    for (uint k = 0u; k < neighbours->count; ++k) {
        const float2 offset = neighbours->offsets[k];
        uu += offset.x * offset.x;
        uv += offset.x * offset.y;
        vv += offset.y * offset.y;
    }
    const float middle = 0.5f * (uu + vv), spread = sqrt(0.25f * (uu - vv) * (uu - vv) + uv * uv);
    if (!(middle - spread < ALONG_A_LINE * (middle + spread))) return (float2)(0.0f);
    return uu >= vv ? normalize((float2)(middle + spread - vv, uv)) : normalize((float2)(uv, middle + spread - uu));
}

// By which each neighbour's flux is to be multiplied for the mean to be 1.
static inline float inverse_mean_flux(const Neighbours* neighbours)
{
#if EQUAL_FLUX
    float sum = 0.0f;
    for (uint k = 0u; k < neighbours->count; ++k) sum += neighbours->flux[k];
    return (float)neighbours->count / fmax(sum, 1e-30f);
#else
    return 0.0f;
#endif
}

static inline float push_of(const Neighbours* neighbours, uint k, float inverse_mean)
{
#if EQUAL_FLUX
    return fmax(2.0f - neighbours->flux[k] * inverse_mean, 0.0f);
#else
    return 1.0f;
#endif
}

static inline float2 displacement(const Neighbours* neighbours)
{
    const float r = sqrt(neighbours->squares[neighbours->count - 1u]), inverse_mean = inverse_mean_flux(neighbours);
    float2 away = (float2)(0.0f), centroid = (float2)(0.0f);
    for (uint k = 0u; k < neighbours->count; ++k) {
        away -= neighbours->offsets[k] * ((r * rsqrt(neighbours->squares[k]) - 1.0f) * push_of(neighbours, k, inverse_mean));
        centroid += neighbours->offsets[k];
    }
    away /= (float)neighbours->count;
    centroid /= (float)neighbours->count;
    away += centroid * (1.0f / 3.0f); // no force of a gradient
    const float2 line = line_of(neighbours);
    if (line.x != 0.0f || line.y != 0.0f) away = line * dot(away, line);
    const float outwards = -dot(away, centroid);
    if (dot(centroid, centroid) > ONE_SIDED * ONE_SIDED * r * r && outwards > 0.0f) away += centroid * (outwards / dot(centroid, centroid));
    return away;
}

__kernel void relax_photons(PhotonGrid grid, __global const uint* restrict cell_ends, uint cell_ends_offset, __global const float* restrict streams,
                            Relaxation relaxation, uint count, __global Photon* restrict photons)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const Photon photon = photons[index];
    const float3 normal = unpack_normal(photon.normal_depth);
    const Frame frame = make_frame(normal);
    GatherQuery self;
    self.position = photon.position;
    self.normal = pack(normal);
    self.flags = 0u;
    self.max_photon_depth = PHOTON_MAX_DEPTH;
    Neighbours neighbours;
    for (float radius = fmin(relaxation.first_radius, relaxation.largest_radius);; radius = fmin(2.0f * radius, relaxation.largest_radius)) {
        neighbours.count = 0u;
        float limit = radius * radius;
        const CellRange range = cells_within(&grid, unpack(photon.position), radius);
        for (uint z = range.z0; z <= range.z1; ++z)
            for (uint y = range.y0; y <= range.y1; ++y)
                limit = add_neighbours(row_run(&grid, cell_ends + cell_ends_offset, &range, y, z), &self, unpack_direction(photon.direction),
                                       relaxation.least_cosine, frame, streams, grid.stride, limit, &neighbours);
        if (neighbours.count == NEIGHBOURS || radius >= relaxation.largest_radius) break;
    }
    if (neighbours.count < LEAST_NEIGHBOURS) return;
    const float2 away = relaxation.step * displacement(&neighbours);
    photons[index].position = pack(unpack(photon.position) + frame.s * away.x + frame.t * away.y);
}
