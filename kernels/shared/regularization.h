// Path space regularization: how far a specular direction may be off [Kaplanyan and Dachsbacher 2013].
#ifndef SUNDOG_SHARED_REGULARIZATION_H
#define SUNDOG_SHARED_REGULARIZATION_H
#include "shared/platform.h"
SHARED_BEGIN

// The cone of half angle gamma around a specular direction.
typedef struct Regularization {
    float one_minus_cos;       // 1 - cos gamma
    float inverse_solid_angle; // 1 / (2 pi (1 - cos gamma)), 1/sr
} Regularization;
SHARED_SIZE(Regularization, 8);

SHARED_END
#endif
