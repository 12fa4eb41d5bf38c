// What is known of the error of an image [Hachisuka, Jarosz and Jensen 2010].
#ifndef SUNDOG_SHARED_ERROR_ESTIMATE_H
#define SUNDOG_SHARED_ERROR_ESTIMATE_H
#include "shared/vec3.h"
SHARED_BEGIN

// What estimators/laplacian.h and nearest_laplacian.h return.
typedef struct LaplacianSum {
    Vec3 laplacian; // of the irradiance (W/m^4), times emitted paths
} LaplacianSum;
SHARED_SIZE(LaplacianSum, 12);

// No Laplacian is estimated from a disk narrower than this multiple of the lookup's own: at 1.5 the bias of the uniform kernel has
// two fifths of the estimate's variance.
#define NARROWEST_LAPLACIAN 1.5f

// Squared errors relative to L^2 + RELATIVE_ERROR_OFFSET, summed over pixels and their three channels.
typedef struct RelativeSquares {
    float bound; // |bias| + t standard errors
    float bias;
    float noise; // one standard error
} RelativeSquares;
SHARED_SIZE(RelativeSquares, 12);

// Of relative squared errors, as everywhere (film/compare.h): (W/m^2/sr)^2.
#define RELATIVE_ERROR_OFFSET 0.01f

SHARED_END
#endif
