// A pixel's radius, and the count of photons that it shrinks by [Hachisuka, Ogaki and Jensen 2008, ACM TOG 27(5)].
#ifndef SUNDOG_SHARED_COUNTED_RADIUS_H
#define SUNDOG_SHARED_COUNTED_RADIUS_H
#include "shared/vec3.h"
SHARED_BEGIN

typedef struct CountedPixel {
    float radius_squared; // of the next iteration (m^2)
    float count;          // photons kept; what rounding has taken from it is in count_error
    float count_error;
} CountedPixel;
SHARED_SIZE(CountedPixel, 12);

SHARED_END
#endif
