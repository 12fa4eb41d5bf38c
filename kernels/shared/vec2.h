// A packed pair: texture coordinates.
#ifndef SUNDOG_SHARED_VEC2_H
#define SUNDOG_SHARED_VEC2_H
#include "shared/platform.h"
SHARED_BEGIN

typedef struct Vec2 {
    float x, y;
} Vec2;
SHARED_SIZE(Vec2, 8);

SHARED_END
#endif
