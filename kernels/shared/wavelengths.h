// Spectral transport: the three wavelengths of a pass, and what they have to do with linear sRGB.
#ifndef SUNDOG_SHARED_WAVELENGTHS_H
#define SUNDOG_SHARED_WAVELENGTHS_H
#include "shared/vec3.h"
SHARED_BEGIN

// Shared by all paths of a pass, from the camera and from the lights. Where the scene says red, green and blue, transport
// computes with one value for each wavelength. docs/spectral.md derives the matrices.
typedef struct Wavelengths {
    Vec3 micrometres;
    Vec3 reflectance[3]; // row k: reflectance at wavelength k = row . rgb
    Vec3 emission[3];    // the same for what lights emit
    Vec3 to_rgb[3];      // row c: channel c of a film sample = row . (values at the wavelengths)
    // Heroes of paths step on by these from pass to pass, 0, 1 or 2 (scene/dispersion.h).
    uint camera_turn;
    uint light_turn;
} Wavelengths;
SHARED_SIZE(Wavelengths, 128);

SHARED_END
#endif
