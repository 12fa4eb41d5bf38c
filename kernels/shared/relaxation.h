// How photons are moved apart [Spencer and Jones 2009, Computer Graphics Forum 28(2), Into the Blue].
#ifndef SUNDOG_SHARED_RELAXATION_H
#define SUNDOG_SHARED_RELAXATION_H
#include "shared/vec3.h"
SHARED_BEGIN

typedef struct Relaxation {
    float first_radius;   // where the search for neighbours begins (scene units)
    float largest_radius; // and where it ends
    float least_cosine;   // between directions of photons that count as neighbours; -1: of any
} Relaxation;
SHARED_SIZE(Relaxation, 12);

SHARED_END
#endif
