// Bernoulli trials: how likely is a camera subpath to come near a light vertex? [Qin et al. 2015, section 5].
#ifndef SUNDOG_SHARED_TRIALS_H
#define SUNDOG_SHARED_TRIALS_H
#include "shared/platform.h"
SHARED_BEGIN

// Of one pair of vertices. count: trials so far. sum: what becomes the estimate of 1 / P (times the cone's solid angle). weight: of the
// next trial in it. bound: of the density in the cone around the ball (1/sr), as far as is known; 0: directions are those of the
// lobe itself.
typedef struct TrialState {
    uint count;
    float sum;
    float weight;
    float bound;
} TrialState;
SHARED_SIZE(TrialState, 16);

// A trial succeeds if its ray meets the ball and u does not lie below 1 - chance.
typedef struct Trial {
    float chance;
    float u;
} Trial;
SHARED_SIZE(Trial, 8);

SHARED_END
#endif
