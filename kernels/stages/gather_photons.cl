// Asks the photon map: for each query, the estimator's sum over the photons within its radius that lie on its
// side of the surface and do not make the path too long. Reads queries, cell ends and photon streams; writes
// sums (zero where there is no query). One work-item a query; eight photons at a time. The estimator
// (kernels/estimators) is the program's prelude. Used by the photon mapping methods.
#include "density/photon_grid.h"
#include "math/simd8.h"

// Photons whose normal is further than this from the query's lie on another surface.
#define MIN_NORMAL_COSINE 0.7f

// Lanes whose packed normal is close to the query's: n . m > c |m| for the unnormalised octahedral m.
static inline int8 on_same_side(uint8 packed, float3 normal)
{
    float8 x = convert_float8(as_int8(packed & 0xfffu)) * (1.0f / 2048.0f) - (2047.5f / 2048.0f);
    float8 y = convert_float8(as_int8((packed >> 12) & 0xfffu)) * (1.0f / 2048.0f) - (2047.5f / 2048.0f);
    const float8 ax = fabs(x), ay = fabs(y);
    const float8 z = 1.0f - ax - ay;
    const float8 fold = z < 0.0f ? -z : (float8)(0.0f);
    x -= copysign(fold, x);
    y -= copysign(fold, y);
    const float8 cosine = x * normal.x + y * normal.y + z * normal.z;
    return (cosine > 0.0f) & (cosine * cosine > (MIN_NORMAL_COSINE * MIN_NORMAL_COSINE) * (x * x + y * y + z * z));
}

static inline float8 load_stream(__global const float* streams, uint stream, uint stride, uint i) { return vload8(0, streams + (size_t)stream * stride + i); }

// The estimate goes in and comes out by value, so that it stays in registers through the loop.
static inline Estimate gather_run(PhotonRun run, const GatherQuery* query, __global const float* streams, uint stride, Estimate estimate)
{
    const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
    const float3 position = unpack(query->position), normal = unpack(query->normal);
    const float inverse_radius_squared = 1.0f / (query->radius * query->radius);
    const uint8 max_depth = (uint8)(min(query->max_photon_depth, 255u));
    for (uint i = run.begin; i < run.end; i += 8u) {
        const float8 dx = load_stream(streams, PHOTON_X, stride, i) - position.x;
        const float8 dy = load_stream(streams, PHOTON_Y, stride, i) - position.y;
        const float8 dz = load_stream(streams, PHOTON_Z, stride, i) - position.z;
        const float8 t_squared = (dx * dx + dy * dy + dz * dz) * inverse_radius_squared;
        int8 mask = (t_squared < 1.0f) & (lane < (int8)((int)(run.end - i)));
        if (!mask8(mask)) continue;
        const uint8 normal_depth = as_uint8(load_stream(streams, PHOTON_NORMAL_DEPTH, stride, i));
        mask &= on_same_side(normal_depth, normal) & as_int8((normal_depth >> 24) <= max_depth);
        estimator_add(&estimate, mask, t_squared, load_stream(streams, PHOTON_RED, stride, i), load_stream(streams, PHOTON_GREEN, stride, i),
                      load_stream(streams, PHOTON_BLUE, stride, i));
    }
    return estimate;
}

__kernel void gather_photons(PhotonGrid grid, __global const uint* restrict cell_ends, uint cell_ends_offset, __global const float* restrict streams,
                             __global const GatherQuery* restrict queries, uint count, __global GatherSum* restrict sums)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const GatherQuery query = queries[index];
    GatherSum sum = {{0.0f, 0.0f, 0.0f}, 0.0f};
    if (query.radius > 0.0f) {
        PhotonRun runs[8];
        const uint run_count = find_photon_runs(&grid, cell_ends + cell_ends_offset, unpack(query.position), runs);
        Estimate estimate;
        estimator_begin(&estimate);
        for (uint i = 0u; i < run_count; ++i) estimate = gather_run(runs[i], &query, streams, grid.stride, estimate);
        sum = estimator_end(&estimate, query.radius);
    }
    sums[index] = sum;
}
