// Where the scene's linear sRGB becomes what transport computes with: itself, or with -D SPECTRAL=1 values at the three
// wavelengths of the pass.
#ifndef SUNDOG_SCENE_SPECTRAL_H
#define SUNDOG_SCENE_SPECTRAL_H
#include "math/matrix3.h"
#include "scene/scene_view.h"
#ifndef SPECTRAL
#define SPECTRAL 0
#endif

static inline float3 transport_reflectance(const SurfaceView* scene, float3 rgb)
{
#if SPECTRAL
    return rows_times(scene->globals->wavelengths.reflectance, rgb);
#else
    return rgb;
#endif
}

static inline float3 transport_emission(const SurfaceView* scene, float3 rgb)
{
#if SPECTRAL
    return rows_times(scene->globals->wavelengths.emission, rgb);
#else
    return rgb;
#endif
}

#endif
