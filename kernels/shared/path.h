// What a path carries from vertex to vertex, and the rules it follows.
#ifndef SUNDOG_SHARED_PATH_H
#define SUNDOG_SHARED_PATH_H
#include "shared/vec3.h"
SHARED_BEGIN

// Camera paths: `throughput` is beta, the product of f cos / pdf so far (with the pixel filter's
// weight). Light paths: it is the flux Phi (W), not yet divided by the number of paths.
typedef struct PathState {
    Vec3 throughput;
    float pdf_w;     // of the last scattering, 1/sr; PDF_DELTA after a specular one or at the start
    uint depth;      // edges so far, counting the ray under way
    uint scattered;  // non-specular scatterings so far
    float eta_scale; // product of squared relative indices: what Russian roulette must not count as loss
    uint flags;
} PathState;
SHARED_SIZE(PathState, 32);

#define PDF_DELTA 0.0f

// A light path from a point or a direction: no camera path can hit its light.
#define PATH_FROM_DELTA_LIGHT 1u
// Dispersion has left the path one of its three wavelengths (kernels/scene/dispersion.h).
#define PATH_ONE_WAVELENGTH 2u
// From a single ray of light, which next-event estimation does not find either.
#define PATH_FROM_COLLIMATED_LIGHT 4u
// A light path that a lobe has scattered which is neither specular nor narrow.
#define PATH_SCATTERED_BROADLY 8u
// A camera path with two vertices in a row, the lens one of them, that light subpaths can be connected between.
#define PATH_CONNECTABLE 16u
// A camera path that some surface has turned: where it does not go straight on, hidden lights are seen again.
#define PATH_TURNED 32u

// max_depth: most edges of a whole path from light to camera, UNBOUNDED_DEPTH for no bound.
// rr_depth: Russian roulette starts at this vertex.
typedef struct PathRules {
    uint max_depth;
    uint rr_depth;
} PathRules;
SHARED_SIZE(PathRules, 8);

#define UNBOUNDED_DEPTH 0xffffffffu

// What became of a path at a vertex: shading stages write it, work queues read it.
#define PATH_ENDED 0u
#define PATH_ALIVE 1u   // goes on: a ray was written
#define PATH_DEPOSIT 2u // left a record: a photon, a splat

SHARED_END
#endif
