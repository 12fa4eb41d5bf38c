// Asks the photon map: for each query, the estimator's sum over the photons within its radius that lie on its
// side of the surface and do not make the path too long. Reads queries, cell ends and photon streams; writes
// sums (zero where there is no query). One work-item a query; eight photons at a time. The estimator
// (kernels/estimators) is the program's prelude. -D WIDE_QUERIES=1: radii may exceed the one that the grid was built for,
// which is dense. Used by the photon mapping methods.
#include "density/flux8.h"
#include "density/photon_grid.h"
#include "density/wanted_photons.h"
#include "math/simd8.h"
#include "shared/bsdf.h"
// -D GATHERS_LOBES=1 where queries may come from lobes other than diffuse ones.
#if GATHERS_LOBES
#include "scene/bsdf.h"
#endif

#if GATHERS_LOBES
// Flux times f of the photons in the mask, one after another; zero for the others.
static inline Flux8 scattered_flux(Flux8 flux, uint8 directions, int8 mask, __global const LobeRecord* record)
{
    float red[8], green[8], blue[8];
    uint direction[8];
    int lane_mask[8];
    vstore8(flux.red, 0, red);
    vstore8(flux.green, 0, green);
    vstore8(flux.blue, 0, blue);
    vstore8(directions, 0, direction);
    vstore8(mask, 0, lane_mask);
    Surface surface;
    const Scattering scattering = unpack_lobe(record, &surface);
    for (int i = 0; i < 8; ++i) {
        const float3 f = lane_mask[i] ? evaluate_for_photon(&scattering, &surface, -unpack_direction(direction[i])) : (float3)(0.0f);
        red[i] = lane_mask[i] ? red[i] * f.x : 0.0f;
        green[i] = lane_mask[i] ? green[i] * f.y : 0.0f;
        blue[i] = lane_mask[i] ? blue[i] * f.z : 0.0f;
    }
    const Flux8 scattered = {vload8(0, red), vload8(0, green), vload8(0, blue)};
    return scattered;
}
#endif

// The estimate goes in and comes out by value, so that it stays in registers through the loop.
static inline Estimate gather_run(PhotonRun run, const GatherQuery* query, __global const LobeRecord* lobe, __global const float* streams, uint stride, Estimate estimate)
{
    const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
    const float3 position = unpack(query->position);
    const float inverse_radius_squared = 1.0f / (query->radius * query->radius);
    for (uint i = run.begin; i < run.end; i += 8u) {
        const Offset8 offset = photon_offsets(streams, stride, i, position);
        const float8 t_squared = squared_lengths(offset) * inverse_radius_squared;
        int8 mask = (t_squared < 1.0f) & (lane < (int8)((int)(run.end - i)));
        if (!mask8(mask)) continue;
        const uint8 normal_depth = as_uint8(load_stream(streams, PHOTON_NORMAL_DEPTH, stride, i));
        mask &= wanted(normal_depth, query);
        Flux8 flux = {load_stream(streams, PHOTON_RED, stride, i), load_stream(streams, PHOTON_GREEN, stride, i), load_stream(streams, PHOTON_BLUE, stride, i)};
#if GATHERS_LOBES
        if (query->flags & QUERY_EVALUATES_LOBE)
            flux = scattered_flux(flux, as_uint8(load_stream(streams, PHOTON_DIRECTION, stride, i)), mask, lobe);
#endif
        estimator_add(&estimate, mask, offset, t_squared, flux.red, flux.green, flux.blue);
    }
    return estimate;
}

__kernel void gather_photons(PhotonGrid grid, __global const uint* restrict cell_ends, uint cell_ends_offset, __global const float* restrict streams,
                             __global const GatherQuery* restrict queries, __global const LobeRecord* restrict query_lobes, uint count, __global ESTIMATOR_RESULT* restrict sums)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const GatherQuery query = queries[index];
    ESTIMATOR_RESULT sum = {{0.0f}};
    if (query.radius > 0.0f) {
        const float3 position = unpack(query.position);
        Estimate estimate;
        estimator_begin(&estimate, &query);
#if WIDE_QUERIES
        const CellRange range = cells_within(&grid, position, query.radius);
        for (uint z = range.z0; z <= range.z1; ++z)
            for (uint y = range.y0; y <= range.y1; ++y)
                estimate = gather_run(row_run(&grid, cell_ends + cell_ends_offset, &range, y, z), &query, query_lobes + index, streams, grid.stride, estimate);
#else
        PhotonRun runs[8];
        const uint run_count = find_photon_runs(&grid, cell_ends + cell_ends_offset, position, runs);
        for (uint i = 0u; i < run_count; ++i) estimate = gather_run(runs[i], &query, query_lobes + index, streams, grid.stride, estimate);
#endif
        sum = estimator_end(&estimate, query.radius);
    }
    sums[index] = sum;
}
