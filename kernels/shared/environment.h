// Light from far away that differs with its direction: an image around the scene.
#ifndef SUNDOG_SHARED_ENVIRONMENT_H
#define SUNDOG_SHARED_ENVIRONMENT_H
#include "shared/vec3.h"
SHARED_BEGIN

// A latitude-longitude image of radiance, bilinear between texel centres. Its columns go round the local y axis, the
// outermost rows lie at the poles. Chosen by patches, the squares between four texels: width x rows of them, each with
// an entry of environment_alias; its weight is the mean luminance of its corners times the sine of the polar angle
// at its middle.
typedef struct EnvironmentMap {
    Vec3 axis_x; // local axes in world space, unit length and orthogonal
    uint width;  // texels
    Vec3 axis_y; // towards the first row
    uint height;
    Vec3 axis_z;
    uint first_texel; // its place in `texels`, in uints: three floats a texel
    uint rows;        // of patches: height - 1, or 1
    float pdf_scale;  // times a patch's weight, over the sine of the polar angle: pdf_w
    uint unused[2];
} EnvironmentMap;
SHARED_SIZE(EnvironmentMap, 64);

SHARED_END
#endif
