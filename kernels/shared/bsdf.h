// Surface scattering: the record of one BSDF.
#ifndef SUNDOG_SHARED_BSDF_H
#define SUNDOG_SHARED_BSDF_H
#include "shared/vec3.h"
SHARED_BEGIN

#define BSDF_DIFFUSE 0u         // reflectance
#define BSDF_DIELECTRIC 1u      // eta, reflectance and transmittance (both 1 in nature)
#define BSDF_THIN_DIELECTRIC 2u // the same, for a pane without thickness
#define BSDF_CONDUCTOR 3u       // eta_rgb, k_rgb, reflectance
#define BSDF_NULL 4u            // lets all light pass

// Scatters on both sides: the back by the BSDF `back`. Without it, the back of
// an opaque BSDF is black, as in Mitsuba.
#define BSDF_TWO_SIDED 1u

typedef struct Bsdf {
    uint type;
    uint flags;
    uint back;
    float eta; // interior over exterior index of refraction; the normal points to the exterior
    Vec3 reflectance;
    float unused0;
    Vec3 transmittance;
    float unused1;
    Vec3 eta_rgb; // complex index of refraction relative to the exterior, for red, green and blue
    float unused2;
    Vec3 k_rgb;
    float unused3;
} Bsdf;
SHARED_SIZE(Bsdf, 80);

SHARED_END
#endif
