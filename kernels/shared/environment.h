// Light from far away that differs with its direction: an image around the scene.
#ifndef SUNDOG_SHARED_ENVIRONMENT_H
#define SUNDOG_SHARED_ENVIRONMENT_H
#include "shared/vec3.h"
SHARED_BEGIN

// A latitude-longitude image of radiance, bilinear between texel centres. Its columns go round the local y axis, the
// outermost rows lie at the poles, or the last one where the image ends: beyond it no light comes. Chosen by patches, the squares between four texels: width x rows of them, each with
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
    float polar_range; // of the rows (rad): pi, or less
    float inverse_polar_range;
    // A sun before the image: a disk of directions, uniform in solid angle, with an image of its own.
    Vec3 sun_direction; // towards its middle, unit length
    float sun_share;    // chance that a direction is chosen within the disk; 0: there is no sun
    Vec3 sun_tangent;   // along which its image's columns grow; unit length, orthogonal to the direction
    float sun_one_minus_cos; // of the angle between its middle and its rim
    uint sun_width;       // texels of the square around the disk, in both directions
    uint sun_first_texel; // as first_texel
    uint unused[2];
} EnvironmentMap;
SHARED_SIZE(EnvironmentMap, 112);

SHARED_END
#endif
