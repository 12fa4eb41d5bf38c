// The photon grid: which cell a point lies in, and which cells a query visits.
#ifndef SUNDOG_PHOTON_GRID_H
#define SUNDOG_PHOTON_GRID_H
#include "math/hash.h"
#include "math/vec3.h"
#include "shared/photon.h"

// Table entry of cell (0, y, z); the row's other cells follow.
static inline uint grid_row(const PhotonGrid* grid, uint y, uint z)
{
    return grid->hashed ? hash_uint(y * 0x9e3779b9u + z * 0x85ebca6bu) : (z * grid->cells_y + y) * grid->cells_x;
}

static inline uint grid_entry(const PhotonGrid* grid, uint row, uint x) { return grid->hashed ? (row + x) & (grid->cell_count - 1u) : row + x; }

// Cell of a photon; photons outside of the grid (by rounding) go to its border.
static inline uint cell_of_photon(const PhotonGrid* grid, float3 position)
{
    const float3 cell = (position - unpack(grid->origin)) * grid->inverse_cell_size;
    const uint x = min((uint)fmax(cell.x, 0.0f), grid->cells_x - 1u);
    const uint y = min((uint)fmax(cell.y, 0.0f), grid->cells_y - 1u);
    const uint z = min((uint)fmax(cell.z, 0.0f), grid->cells_z - 1u);
    return grid_entry(grid, grid_row(grid, y, z), x);
}

// Photons [begin, end) of the map. A query meets at most eight runs.
typedef struct PhotonRun {
    uint begin, end;
} PhotonRun;

static inline PhotonRun photon_run(__global const uint* cell_ends, uint first, uint last)
{
    PhotonRun run = {first == 0u ? 0u : cell_ends[first - 1u], cell_ends[last]};
    return run;
}

// The runs that hold all photons within the radius that the grid was built for. Dense: one run a row,
// of two neighbouring cells. Hashed: one a cell, each table entry once, since several cells may share it.
static inline uint find_photon_runs(const PhotonGrid* grid, __global const uint* cell_ends, float3 position, PhotonRun runs[8])
{
    const float3 cell = (position - unpack(grid->origin)) * grid->inverse_cell_size - 0.5f;
    const int x = (int)floor(cell.x), y = (int)floor(cell.y), z = (int)floor(cell.z);
    const uint x0 = (uint)clamp(x, 0, (int)grid->cells_x - 1), x1 = (uint)clamp(x + 1, 0, (int)grid->cells_x - 1);
    const uint y0 = (uint)clamp(y, 0, (int)grid->cells_y - 1), y1 = (uint)clamp(y + 1, 0, (int)grid->cells_y - 1);
    const uint z0 = (uint)clamp(z, 0, (int)grid->cells_z - 1), z1 = (uint)clamp(z + 1, 0, (int)grid->cells_z - 1);
    uint count = 0u;
    uint seen[8];
    for (uint cz = z0; cz <= z1; ++cz) {
        for (uint cy = y0; cy <= y1; ++cy) {
            const uint row = grid_row(grid, cy, cz);
            if (!grid->hashed) {
                runs[count++] = photon_run(cell_ends, row + x0, row + x1);
                continue;
            }
            for (uint cx = x0; cx <= x1; ++cx) {
                const uint entry = grid_entry(grid, row, cx);
                bool visited = false;
                for (uint i = 0u; i < count; ++i) visited = visited || seen[i] == entry;
                if (visited) continue;
                seen[count] = entry;
                runs[count++] = photon_run(cell_ends, entry, entry);
            }
        }
    }
    return count;
}

// Cells of a dense grid that a ball touches; those beyond the grid's border are its border's, where photons outside lie.
typedef struct CellRange {
    uint x0, x1, y0, y1, z0, z1; // all included
} CellRange;

static inline CellRange cells_within(const PhotonGrid* grid, float3 position, float radius)
{
    // Rounding may have put a photon into the next cell.
    const float3 reach = radius * grid->inverse_cell_size + 1e-3f;
    const float3 cell = (position - unpack(grid->origin)) * grid->inverse_cell_size;
    const float3 last = (float3)((float)(grid->cells_x - 1u), (float)(grid->cells_y - 1u), (float)(grid->cells_z - 1u));
    const float3 low = clamp(cell - reach, (float3)(0.0f), last), high = clamp(cell + reach, (float3)(0.0f), last);
    const CellRange range = {(uint)low.x, (uint)high.x, (uint)low.y, (uint)high.y, (uint)low.z, (uint)high.z};
    return range;
}

// The photons of one of its rows.
static inline PhotonRun row_run(const PhotonGrid* grid, __global const uint* cell_ends, const CellRange* range, uint y, uint z)
{
    const uint row = grid_row(grid, y, z);
    return photon_run(cell_ends, row + range->x0, row + range->x1);
}

#endif
