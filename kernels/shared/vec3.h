// A packed triple: positions and directions in world space, and linear sRGB colours.
#ifndef SUNDOG_SHARED_VEC3_H
#define SUNDOG_SHARED_VEC3_H
#include "shared/platform.h"
SHARED_BEGIN

typedef struct Vec3 {
    float x, y, z;
} Vec3;
SHARED_SIZE(Vec3, 12);

SHARED_END
#endif
