// The sensor: pinhole or thin lens, with Mitsuba's frame: the camera looks along
// its +z, +y is up in the image, and +x points to the image's left.
#ifndef SUNDOG_SHARED_CAMERA_H
#define SUNDOG_SHARED_CAMERA_H
#include "shared/vec3.h"
SHARED_BEGIN

// Columns of the camera-to-world rotation are unit length.
typedef struct Camera {
    Vec3 position;
    float tan_half_x; // tangent of half the horizontal field of view of the full film
    Vec3 axis_x;
    float tan_half_y;
    Vec3 axis_y;
    float aperture_radius; // 0: pinhole
    Vec3 axis_z;
    float focus_distance; // of the plane in focus, along axis_z
    float near_clip;
    float far_clip;
    int film_width; // full film (pixels); the tangents refer to it
    int film_height;
    int crop_x; // the part that is rendered
    int crop_y;
    int crop_width;
    int crop_height;
} Camera;
SHARED_SIZE(Camera, 96);

// A separable reconstruction filter, tabulated for sampling on [-radius, radius]
// by piecewise constant bins. cdf: of |f|. sign_scale: for each bin the weight
// of a sample that falls there, sign(f) * integral |f| / integral f.
#define FILTER_BINS 64
typedef struct PixelFilter {
    float radius; // pixels
    float unused[3];
    float cdf[FILTER_BINS + 1];
    float sign_scale[FILTER_BINS];
    float density[FILTER_BINS]; // f in each bin, normalised to integrate to 1 (1/pixel)
} PixelFilter;
SHARED_SIZE(PixelFilter, 16 + 4 * (FILTER_BINS + 1 + 2 * FILTER_BINS));

SHARED_END
#endif
