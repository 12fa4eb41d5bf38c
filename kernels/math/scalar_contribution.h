// What a colour counts for as one number: never negative, and 0 only where all of it is. (Pixel filters have negative lobes.)
#ifndef SUNDOG_SCALAR_CONTRIBUTION_H
#define SUNDOG_SCALAR_CONTRIBUTION_H
#include "math/luminance.h"

static inline float scalar_contribution(float3 colour) { return dot(fabs(colour), LUMINANCE_WEIGHTS); }

#endif
