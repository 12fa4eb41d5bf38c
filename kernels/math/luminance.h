// Luminance of linear sRGB.
#ifndef SUNDOG_LUMINANCE_H
#define SUNDOG_LUMINANCE_H

#define LUMINANCE_WEIGHTS ((float3)(0.2126f, 0.7152f, 0.0722f)) // ITU-R BT.709

#endif
