// A hierarchy of lights, by which next-event estimation chooses one for a point [Conty Estevez and Kulla 2018].
#ifndef SUNDOG_SHARED_LIGHT_TREE_H
#define SUNDOG_SHARED_LIGHT_TREE_H
#include "shared/vec3.h"
SHARED_BEGIN

#define NO_NODE 0xffffffffu
#define SHARE_BY_IMPORTANCE -1.0f

// Node i below globals.light_count is light i, the others have two children, and node globals.light_count is the root.
// Lights that lie below a node are within a sphere, and shine within spread + reach of the axis: fully up to the
// spread, beyond it by the cosine of what the angle exceeds it at most.
typedef struct LightNode {
    Vec3 center;
    float radius;
    Vec3 axis; // unit length
    float cos_spread;
    float cos_reach; // the reach is at most pi / 2
    float intensity; // greatest radiant intensities, added up; as a part of all lights'
    uint first, second; // children
    uint parent;        // NO_NODE of the root and of lights that are never chosen
    float first_share;  // chance of the first child, for all points; or SHARE_BY_IMPORTANCE
    float sin_spread;
    uint unused;
} LightNode;
SHARED_SIZE(LightNode, 64);

SHARED_END
#endif
