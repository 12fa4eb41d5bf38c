// Photons, the grid that finds them, and those who ask.
#ifndef SUNDOG_SHARED_PHOTON_H
#define SUNDOG_SHARED_PHOTON_H
#include "shared/vec3.h"
SHARED_BEGIN

// One light subpath's visit to a surface.
typedef struct Photon {
    Vec3 position;
    uint direction; // of propagation, packed
    Vec3 flux;      // W, not divided by the number of emitted subpaths; the BSDF here is not in it
    uint normal_depth; // the normal on the side the light came from, PHOTON_UNREACHED, and edges so far (density/photon_depth.h)
} Photon;
SHARED_SIZE(Photon, 32);

// From a light that no path can hit, by specular surfaces alone: a camera path that is followed beyond the photon's
// place cannot find it.
#define PHOTON_UNREACHED (1u << 24)
// The high 7 bits of normal_depth are the edges so far, and the low 24 the normal. Photons of PHOTON_DEEP edges or more are rare:
// their high bits are PHOTON_DEEP, their low 24 the edges beyond that (14 bits), and a coarser normal above those.
#define PHOTON_DEPTH_SHIFT 25u
#define PHOTON_DEEP 127u
#define PHOTON_MOST_BEYOND 0x3fffu // deeper ones count as this deep: a path of albedo .999 keeps 1e-7 of its flux until then

// Which photons light paths leave (-D PHOTONS_KEPT): all, those that specular and narrow lobes alone have scattered since
// their light, or the others.
#define PHOTONS_ALL 0
#define PHOTONS_CAUSTIC 1
#define PHOTONS_SCATTERED 2

// In the map photons lie as structure of arrays: eight streams, each `stride` long.
#define PHOTON_X 0u
#define PHOTON_Y 1u
#define PHOTON_Z 2u
#define PHOTON_RED 3u
#define PHOTON_GREEN 4u
#define PHOTON_BLUE 5u
#define PHOTON_DIRECTION 6u
#define PHOTON_NORMAL_DEPTH 7u
#define PHOTON_STREAMS 8u
// A query reads eight photons at once, up to seven beyond a cell's end.
#define PHOTON_PADDING 8u

// Cells are cubes with edges of at least twice the largest radius, so a query meets 2 x 2 x 2 of
// them; cells of one (y, z) row follow one another. A scene that fits is laid out densely, else
// rows are hashed into the table.
typedef struct PhotonGrid {
    Vec3 origin;
    float inverse_cell_size;
    uint cells_x; // the grid's size in cells
    uint cells_y;
    uint cells_z;
    uint cell_count; // entries of the table, a power of two when hashed
    uint hashed;
    uint stride; // of the photon streams
    uint unused[2];
} PhotonGrid;
SHARED_SIZE(PhotonGrid, 48);

// What a query asks for.
#define QUERY_EVALUATES_LOBE 1u // f depends on the photon's direction: its LobeRecord says how
#define QUERY_BOTH_SIDES 2u     // the lobe transmits
#define QUERY_UNREACHED_ONLY 4u // the camera path goes on from here and finds all the other photons' paths

// Where a camera path asks for photons.
typedef struct GatherQuery {
    Vec3 position;
    float radius;    // 0: no query
    Vec3 throughput; // beta of the camera path, times f where that does not depend on the photon: for a diffuse lobe beta * rho / pi
    uint max_photon_depth; // photons with more edges would exceed max_depth
    Vec3 normal;     // on the side that the camera sees
    uint flags;
} GatherQuery;
SHARED_SIZE(GatherQuery, 48);

// What an estimator made of the photons that a query found.
typedef struct GatherSum {
    Vec3 flux;   // W (estimators/flux_sum.h) or W/m^2 (radiance_estimate.h), times emitted paths
    float count; // photons, where the estimator counts them
} GatherSum;
SHARED_SIZE(GatherSum, 16);

SHARED_END
#endif
