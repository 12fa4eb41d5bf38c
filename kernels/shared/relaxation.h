// How photons are moved apart [Spencer and Jones 2009, Computer Graphics Forum 28(2), Into the Blue; 2013, ACM TOG 32(1),
// Progressive Photon Relaxation].
#ifndef SUNDOG_SHARED_RELAXATION_H
#define SUNDOG_SHARED_RELAXATION_H
#include "shared/vec3.h"
SHARED_BEGIN

typedef struct Relaxation {
    float first_radius;   // where the search for neighbours begins (scene units)
    float largest_radius; // and where it ends
    float least_cosine;   // between directions of photons that count as neighbours; -1: of any
    float step;           // of the way that a sweep would move a photon
} Relaxation;
SHARED_SIZE(Relaxation, 16);

#define NO_NEAREST_PHOTON 0xffffffffu

SHARED_END
#endif
