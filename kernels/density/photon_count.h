// Local radii: of a fraction alpha of the photons found the count N is kept, and the disk shrinks to hold as many at the
// same density, r'^2 / r^2 = (N + alpha M) / (N + M) for M new ones [Hachisuka, Ogaki and Jensen 2008, eqs. 3 to 5].
#ifndef SUNDOG_PHOTON_COUNT_H
#define SUNDOG_PHOTON_COUNT_H
#include "math/compensated.h"

// Adds M to the count (*count + *error). Returns r'^2 / r^2.
static inline float keep_photons(float* count, float* error, float found, float alpha)
{
    const float before = *count + *error;
    add_compensated(count, error, alpha * found);
    return (before + alpha * found) / (before + found);
}

#endif
