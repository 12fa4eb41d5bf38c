// The sensor: perspective or orthographic, each with or without a thin lens, in Mitsuba's frame: the camera looks along
// its +z, +y is up in the image, and +x points to the image's left.
#ifndef SUNDOG_SHARED_CAMERA_H
#define SUNDOG_SHARED_CAMERA_H
#include "shared/vec3.h"
SHARED_BEGIN

#define CAMERA_PERSPECTIVE 0u
#define CAMERA_ORTHOGRAPHIC 1u

// Columns of the camera-to-world rotation are unit length. The film is measured where its size does not depend on
// the focal length: at distance 1 from a perspective camera; in its own plane, that of the position, for an
// orthographic one (scene units).
typedef struct Camera {
    Vec3 position;
    float half_width; // of the full film; perspective: tangent of half the horizontal field of view
    Vec3 axis_x;
    float half_height;
    Vec3 axis_y;
    float aperture_radius; // 0: all in focus
    Vec3 axis_z;
    float focus_distance; // of the plane in focus, along axis_z
    float near_clip;
    float far_clip;
    int film_width; // full film (pixels)
    int film_height;
    int crop_x; // the part that is rendered
    int crop_y;
    int crop_width;
    int crop_height;
    float shift_x; // of the full film's centre from axis_z, along axis_x and axis_y, in the units of half_width
    float shift_y;
    uint kind; // CAMERA_*
    uint unused;
} Camera;
SHARED_SIZE(Camera, 112);

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
