// Where on the film a light path's contribution goes.
#ifndef SUNDOG_FILM_SPLAT_H
#define SUNDOG_FILM_SPLAT_H
#include "shared/camera.h"

// Chooses one of the pixels whose filter covers a film coordinate, by |weight|. Returns its index along the
// axis and writes sum of |weights| with the weight's sign: one splat instead of many, the same mean.
static inline int choose_filter_pixel(__global const PixelFilter* filter, float coordinate, float u, float* weight)
{
    const int first = (int)ceil(coordinate - filter->radius - 0.5f);
    const int last = (int)floor(coordinate + filter->radius - 0.5f);
    const float bins_per_pixel = 0.5f * FILTER_BINS / filter->radius;
    float total = 0.0f;
    for (int pixel = first; pixel <= last; ++pixel) {
        const int bin = clamp((int)((coordinate - (float)pixel - 0.5f + filter->radius) * bins_per_pixel), 0, FILTER_BINS - 1);
        total += fabs(filter->density[bin]);
    }
    float target = u * total;
    int chosen = first;
    float density = 0.0f;
    for (int pixel = first; pixel <= last; ++pixel) {
        const int bin = clamp((int)((coordinate - (float)pixel - 0.5f + filter->radius) * bins_per_pixel), 0, FILTER_BINS - 1);
        if (filter->density[bin] == 0.0f) continue;
        chosen = pixel;
        density = filter->density[bin];
        target -= fabs(density);
        if (target < 0.0f) break;
    }
    *weight = copysign(total, density);
    return chosen;
}

#endif
