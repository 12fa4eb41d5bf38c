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
#include "density/photon_lanes.h"
#include "density/wanted_photons.h"
#include "math/frame.h"
#include "math/luminance.h"
#include "shared/path.h"
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
static inline float flux_of(const PhotonMap* map, uint place)
{
    if (!EQUAL_FLUX) return 0.0f;
    const float3 flux = (float3)(stream_value(map, PHOTON_RED, place), stream_value(map, PHOTON_GREEN, place), stream_value(map, PHOTON_BLUE, place));
    return dot(flux, LUMINANCE_WEIGHTS);
}

// The neighbours nearer than the root of `limit`, which shrinks once there are enough.
typedef struct Neighbourhood {
    float3 position, direction; // of the photon
    Frame frame;
    const GatherQuery* self;
    float least_cosine;
    float limit;
    Neighbours* neighbours;
} Neighbourhood;
#define VISITOR Neighbourhood

static inline int8 visitor_reach(const Neighbourhood* near, Offset8 offset, float8* squares)
{
    *squares = squared_lengths(offset);
    return (*squares < near->limit) & (*squares > 0.0f); // itself is at 0
}

static inline Neighbourhood visit(Neighbourhood near, const PhotonMap* map, Photons8 photons)
{
    const int8 mask = photons.mask & wanted(as_uint8(load_stream(map, PHOTON_NORMAL_DEPTH, photons.first)), near.self);
    const Offset8 offset = photons.offset;
    const float3 s = near.frame.s, t = near.frame.t;
    float distance[8], u[8], v[8];
    vstore8(photons.squares, 0, distance);
    vstore8(offset.x * s.x + offset.y * s.y + offset.z * s.z, 0, u);
    vstore8(offset.x * t.x + offset.y * t.y + offset.z * t.z, 0, v);
    for (int lanes = mask8(mask); lanes != 0; lanes &= lanes - 1) {
        const int k = first_lane(lanes);
        if (!(distance[k] < near.limit)) continue;
        const uint place = photons.first + (uint)k;
        const uint packed = as_uint(stream_value(map, PHOTON_DIRECTION, place));
        if (near.least_cosine > -1.0f && dot(unpack_direction(packed), near.direction) < near.least_cosine) continue;
        insert_neighbour(near.neighbours, distance[k], (float2)(u[k], v[k]), flux_of(map, place));
        if (near.neighbours->count == NEIGHBOURS) near.limit = near.neighbours->squares[NEIGHBOURS - 1u];
    }
    return near;
}

#include "density/visit_photons.h"

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

__kernel void relax_photons(MAP_PARAMETERS, Relaxation relaxation, uint count, __global Photon* restrict photons)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const PhotonMap map = MAP_VIEW;
    const Photon photon = photons[index];
    const float3 normal = photon_normal(photon.normal_depth);
    const Frame frame = make_frame(normal);
    GatherQuery self;
    self.position = photon.position;
    self.normal = pack(normal);
    self.flags = 0u;
    self.max_photon_depth = UNBOUNDED_DEPTH;
    Neighbours neighbours;
    Neighbourhood near = {unpack(photon.position), unpack_direction(photon.direction), frame, &self, relaxation.least_cosine, 0.0f, &neighbours};
    for (float radius = fmin(relaxation.first_radius, relaxation.largest_radius);; radius = fmin(2.0f * radius, relaxation.largest_radius)) {
        neighbours.count = 0u;
        near.limit = radius * radius;
        visit_photons_within(near, &map, radius);
        if (neighbours.count == NEIGHBOURS || radius >= relaxation.largest_radius) break;
    }
    if (neighbours.count < LEAST_NEIGHBOURS) return;
    const float2 away = relaxation.step * displacement(&neighbours);
    photons[index].position = pack(unpack(photon.position) + frame.s * away.x + frame.t * away.y);
}
